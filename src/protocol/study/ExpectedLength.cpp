#include "protocol/study/ExpectedLength.h"

#include <algorithm>

#include "tasks/Tasks.h"

namespace heft {

namespace {
// Calls visit with the keys of each block of trials.
template <typename Visit>
void each_block_of_trials(const Protocol& protocol, const Visit& visit) {
  for (const Block& block : protocol.blocks)
    if (const auto* trials = std::get_if<TaskBlock>(&block))
      Tasks::call(trials->task().name,
                  [&]<typename Kind>() { visit(*trials->as<typename Kind::Block>()); });
}
}  // namespace

TrialsByTask expected_trials(const Protocol& protocol) {
  TrialsByTask trials;
  each_block_of_trials(protocol, [&]<typename Keys>(const Keys& keys) {
    trials[std::string(Keys::OfTask::task.name)] += keys.expected_trials();
  });
  return trials;
}

double total_of(const TrialsByTask& trials) {
  double total = 0;
  for (const auto& [task, n] : trials) total += n;
  return total;
}

bool depends_on_answers(const Protocol& protocol) {
  bool depends = false;
  each_block_of_trials(protocol, [&](const auto& keys) {
    if constexpr (requires { keys.depends_on_answers(); }) depends |= keys.depends_on_answers();
  });
  return depends;
}

double expected_minutes(const Protocol& protocol, const TrialsByTask& trials) {
  double seconds = 0;
  for (const Block& block : protocol.blocks) {
    if (const auto* shown = std::get_if<DemonstrationBlock>(&block)) seconds += shown->duration_s;
    if (const auto* pause = std::get_if<BreakBlock>(&block)) seconds += pause->least_duration_s;
  }
  for (const auto& [task, n] : trials)
    seconds += n * (task_named(task).trial_s + protocol.onset.gap_s);
  return seconds / 60;
}

}  // namespace heft
