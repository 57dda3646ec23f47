#include "tasks/TaskRun.h"

#include <algorithm>
#include <limits>

namespace heft {

RandomStream TrialKey::slots() const {
  return RandomStream(seed, "slots", static_cast<std::uint64_t>(trial_number),
                      static_cast<std::uint64_t>(attempt));
}

RandomStream TrialKey::trial(std::string_view purpose) const {
  return RandomStream(seed, purpose, static_cast<std::uint64_t>(trial_number));
}

TrialPlan TrialKey::plan(const std::string& block, std::string_view task,
                         const std::string& condition) const {
  TrialPlan plan;
  plan.trial_number = trial_number;
  plan.attempt = attempt;
  plan.block = block;
  plan.task = Task(task);
  plan.condition = condition;
  return plan;
}

bool TaskTrial::is_heaviest(int slot) const {
  return plan_.masses_g[static_cast<std::size_t>(slot - 1)] == std::ranges::max(plan_.masses_g);
}

void TaskTrial::choose(int slot) {
  result_.chosen_slot = slot;
  if (std::ranges::min(plan_.masses_g) < std::ranges::max(plan_.masses_g))
    result_.choice_correct = is_heaviest(slot);
}

int heaviest_slot(std::span<const double> values, std::span<const int> wrong_slots) {
  const auto ruled_out = wrong_slots.last(std::min(wrong_slots.size(), values.size() - 1));
  int best_slot = 0;
  double best = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < values.size(); ++i) {
    const int slot = static_cast<int>(i) + 1;
    if (std::ranges::find(ruled_out, slot) != ruled_out.end() || values[i] <= best) continue;
    best_slot = slot;
    best = values[i];
  }
  return best_slot;
}

}  // namespace heft
