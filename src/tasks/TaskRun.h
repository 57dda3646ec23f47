// Which attempt at which trial of the session is meant: what its random streams are keyed by, so
// that a void attempt redraws its own arrangement and nothing else.
// What the engine asks of a task: a block of its trials, and one attempt at a trial as its answers
// make it. Both are folded: a run again from the completed trials, a trial from its actions.
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

struct TrialKey {
  std::uint64_t seed = 0;
  int trial_number = 0;
  int attempt = 1;

  /// For what a repeated attempt draws anew: which cube stands where.
  RandomStream slots() const {
    return RandomStream(seed, "slots", static_cast<std::uint64_t>(trial_number),
                        static_cast<std::uint64_t>(attempt));
  }
  /// For what all attempts of a trial share.
  RandomStream trial(std::string_view purpose) const {
    return RandomStream(seed, purpose, static_cast<std::uint64_t>(trial_number));
  }

  TrialPlan plan(const std::string& block, std::string_view task,
                 const std::string& condition) const {
    TrialPlan plan;
    plan.trial_number = trial_number;
    plan.attempt = attempt;
    plan.block = block;
    plan.task = Task(task);
    plan.condition = condition;
    return plan;
  }
};

class PageBuilder;

class TaskTrial {
 public:
  TaskTrial(const TaskDeclaration& task, TrialPlan plan)
      : plan_(std::move(plan)), declaration_(task) {}
  virtual ~TaskTrial() = default;

  const TaskDeclaration& declaration() const { return declaration_; }
  /// As drawn, or rearranged by what was answered (then n_reshuffles is larger).
  const TrialPlan& plan() const { return plan_; }
  const TrialResult& result() const { return result_; }

  /// Why an action of the task, which fills its columns, can't be taken as things stand.
  virtual std::optional<std::string> refusal(const Action& action [[maybe_unused]]) const {
    return std::nullopt;
  }
  /// Whether an action that is not refused ends the trial.
  virtual bool ends(const Action& action) const {
    return !declaration_.action(action.kind)->is_step;
  }
  /// Takes an action that is not refused; one that ends the trial gives it its outcome.
  virtual void take(const Action& action) = 0;

  /// Adds the offer, and whether the last answer is to be tried again or the steps are complete.
  virtual void show(ScreenState& screen) const = 0;

  /// What the answer of a trial that has ended says: what judges of the same trial are compared by.
  virtual std::string answer() const = 0;
  /// The label of each cube in that answer; none: the task gives no labels.
  virtual std::vector<std::string> labels() const { return {}; }

 protected:
  bool is_heaviest(int slot) const {
    return plan_.masses_g[static_cast<std::size_t>(slot - 1)] == std::ranges::max(plan_.masses_g);
  }
  /// Takes a choice of a cube: which, and whether it was the heaviest, where one is.
  void choose(int slot) {
    result_.chosen_slot = slot;
    if (std::ranges::min(plan_.masses_g) < std::ranges::max(plan_.masses_g))
      result_.choice_correct = is_heaviest(slot);
  }

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
  /// Folds a completed trial; the reversals and estimates that it gives go into the changes.
  virtual void complete(const TrialRow& row, Changes& changes) = 0;
  /// The staircase that runs alone where several were to be interleaved; none before that.
  virtual std::optional<std::string> survivor() const { return std::nullopt; }
};

}  // namespace heft
