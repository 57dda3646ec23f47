// Practice before the trials of a block: a number of trials, or until several answers in a row are
// correct, with or without feedback. Practice trials have separate random draws, count in no result
// and advance no procedure: comparisons show their staircases' first levels.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "base/files/Keys.h"
#include "tasks/TaskRun.h"

namespace heft {

struct Practice {
  int trials = 0;         ///< at most, and not more than the block has; 0: none
  int until_correct = 0;  ///< correct answers in a row that end it; 0: all trials are shown
  bool feedback = false;  ///< after each trial, whether the answer was correct

  template <typename Visit>
  void visit_keys(Visit&& visit) {
    visit(ConfigKey{"trials", "at most", true}, trials, WholeRange{1, 100});
    visit(ConfigKey{"until_correct", "in a row"}, until_correct, WholeRange{1, 100});
    visit(ConfigKey{"feedback", "after each trial"}, feedback);
  }
  bool needs_correctness() const { return until_correct > 0 || feedback; }
  std::string in_words() const;
};

/// Whether the answer of a completed trial is correct; none: that is not defined for it.
using IsCorrect = std::optional<bool> (*)(const TrialRow& row);

/// A block's trials after their practice.
class PracticedRun : public TaskRun {
 public:
  /// @param is_correct null: not defined in the task
  PracticedRun(const Practice& practice, std::unique_ptr<TaskRun> practiced,
               std::unique_ptr<TaskRun> counted, IsCorrect is_correct);
  TrialPlan plan(const TrialKey& key) const override;
  bool finished() const override { return !is_practicing() && counted_->finished(); }
  void complete(const TrialRow& row, Changes& changes) override;
  std::optional<std::string> unfinished_staircase() const override {
    return counted_->unfinished_staircase();
  }
  std::optional<bool> feedback() const override { return feedback_; }

 private:
  bool is_practicing() const;

  Practice practice_;
  std::unique_ptr<TaskRun> practiced_, counted_;
  IsCorrect is_correct_;
  int n_done_ = 0, n_correct_in_row_ = 0;
  std::optional<bool> feedback_;
};

}  // namespace heft
