// What a task offers and what its answers mean. One file a task, one row each in TaskRules.cpp.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "experiment/Action.h"
#include "experiment/ScreenState.h"
#include "experiment/TrialPlan.h"

namespace heft {

/// What an attempt's answers have come to so far.
struct TaskState {
  TrialPlan plan;
  std::vector<std::optional<Label>> labels;  ///< by slot
  int n_wrong = 0;                           ///< introduction: wrong choices
  std::optional<int> chosen_slot;
  std::optional<bool> choice_correct;
  std::optional<double> value;  ///< what was estimated or adjusted, once it was validated

  const std::optional<Label>& label_of(int slot) const {
    return labels[static_cast<std::size_t>(slot - 1)];
  }
  std::optional<Label>& label_of(int slot) { return labels[static_cast<std::size_t>(slot - 1)]; }
};

struct TaskRules {
  Task task;
  std::span<const ActionKind> offered;
  /// Why an offered action, which names a cube where it must, can't be taken as things stand.
  std::optional<std::string> (*refusal)(const TaskState& state, const Action& action);
  /// Whether an action that is not refused ends the trial.
  bool (*ends_trial)(const TaskState& state, const Action& action);
  /// Takes an action that is not refused. @return the outcome where it ends the trial
  std::optional<Outcome> (*act)(TaskState& state, const Action& action);
  /// Puts on the screen what the task adds to it; `can_answer` is there already.
  void (*show)(const TaskState& state, ScreenState& screen);
};

const TaskRules& rules_of(Task task);

/// The introduction's, sorting's and comparison's.
extern const TaskRules introduction_rules, sorting_rules, comparison_rules;

bool is_heaviest(const TrialPlan& plan, int slot);

/// Takes a choice of a cube: which, and whether it was the heaviest, where one is.
void choose(TaskState& state, int slot);

}  // namespace heft
