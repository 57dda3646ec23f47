#include "protocol/study/ExpectedLength.h"

#include <algorithm>

#include "tasks/SessionPlan.h"

namespace heft {

TrialsByTask expected_trials(const Protocol& protocol) {
  TrialsByTask trials;
  for (const Block& block : protocol.blocks)
    if (const auto* of_task = std::get_if<TaskBlock>(&block))
      trials[std::string(of_task->task().name)] += of_task->expected_trials();
  return trials;
}

double total_of(const TrialsByTask& trials) {
  double total = 0;
  for (const auto& [task, n] : trials) total += n;
  return total;
}

bool depends_on_answers(const Protocol& protocol) {
  return std::ranges::any_of(protocol.blocks, [](const Block& block) {
    const auto* of_task = std::get_if<TaskBlock>(&block);
    return of_task && of_task->depends_on_answers();
  });
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
