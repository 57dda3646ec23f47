#include "engine/tasks/TaskRules.h"

#include <algorithm>
#include <array>

namespace heft {

const TaskRules& rules_of(Task task) {
  static const std::array table{&introduction_rules, &sorting_rules, &comparison_rules};
  return **std::ranges::find(table, task, &TaskRules::task);
}

bool is_heaviest(const TrialPlan& plan, int slot) {
  return plan.masses_g[static_cast<std::size_t>(slot - 1)] == std::ranges::max(plan.masses_g);
}

void choose(TaskState& state, int slot) {
  const std::vector<double>& masses_g = state.plan.masses_g;
  state.chosen_slot = slot;
  if (std::ranges::min(masses_g) < std::ranges::max(masses_g))
    state.choice_correct = is_heaviest(state.plan, slot);
}

}  // namespace heft
