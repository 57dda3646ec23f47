// What the engine needs of a task: a block of trials (TaskRun) and one attempt at a trial
// (TaskTrial). A run is folded from completed trials, a trial from its actions.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/Random.h"
#include "experiment/EventPayloads.h"
#include "experiment/Rows.h"
#include "experiment/ScreenState.h"
#include "experiment/TrialPlan.h"
#include "tasks/Task.h"

namespace heft {

/// Key of an attempt's random streams: a repeated attempt changes its own arrangement only.
struct TrialKey {
  std::uint64_t seed = 0;
  int trial_number = 0;
  int attempt = 1;

  /// For the arrangement of the cubes, drawn again in each attempt.
  RandomStream slots() const;
  /// For draws that all attempts of a trial share.
  RandomStream trial(std::string_view purpose) const;

  TrialPlan plan(const std::string& block, std::string_view task,
                 const std::string& condition) const;
};

class PageBuilder;

class TaskTrial {
 public:
  TaskTrial(const TaskDeclaration& task, TrialPlan plan)
      : plan_(std::move(plan)), declaration_(task) {}
  virtual ~TaskTrial() = default;

  const TaskDeclaration& declaration() const { return declaration_; }
  /// As drawn, or with other cubes after an answer (n_reshuffles is then larger).
  const TrialPlan& plan() const { return plan_; }
  const TrialResult& result() const { return result_; }

  /// Why an action with valid columns cannot be accepted now; none: it can.
  virtual std::optional<std::string> refusal(const Action& action [[maybe_unused]]) const {
    return std::nullopt;
  }
  /// Whether an accepted action ends the trial.
  virtual bool ends(const Action& action) const {
    return !declaration_.action(action.kind)->is_step;
  }
  /// Folds an accepted action; one that ends the trial sets the outcome.
  virtual void take(const Action& action) = 0;

  /// Sets the offer, try_again and can_validate.
  virtual void show(ScreenState& screen) const = 0;

  /// The answer of an ended trial as a word, by which responders to the same trial are compared.
  virtual std::string answer() const = 0;
  /// The label of each cube in that answer; empty: the task has no labels.
  virtual std::vector<std::string> labels() const { return {}; }
  /// How many answers the trial offers, to score models by the probability that they give to the
  /// logged one. None: the answer is a number.
  virtual std::optional<int> n_answers() const { return std::nullopt; }
  /// Whether its answers state if the cubes differ.
  virtual bool detects() const { return declaration_.detects; }
  /// Whether the answer of an ended trial is that the cubes differ; none: the task does not ask.
  virtual std::optional<bool> answered_different() const {
    return detects() ? std::optional(result_.chosen_slot.has_value()) : std::nullopt;
  }

 protected:
  bool is_heaviest(int slot) const;
  /// Sets the chosen slot, and whether it is the heaviest unless all masses are equal.
  void choose(int slot);

  TrialPlan plan_;
  TrialResult result_;

 private:
  const TaskDeclaration& declaration_;
};

class TaskRun {
 public:
  virtual ~TaskRun() = default;

  virtual TrialPlan plan(const TrialKey& key) const = 0;
  virtual bool finished() const = 0;
  /// Folds a completed trial and adds its reversals and estimates to `changes`.
  virtual void complete(const TrialRow& row, Changes& changes) = 0;
  /// The last unfinished one of several interleaved staircases; none while more are running.
  virtual std::optional<std::string> unfinished_staircase() const { return std::nullopt; }
  /// Whether the last completed trial's answer was correct, if the participant sees it.
  virtual std::optional<bool> feedback() const { return std::nullopt; }
};

}  // namespace heft
