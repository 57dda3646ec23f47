#include "tasks/SessionPlan.h"

#include <stdexcept>

namespace heft {

const TaskBlock& task_block(const SessionPlan& plan, const std::string& name) {
  for (const Block& block : plan.blocks)
    if (const auto* trials = std::get_if<TaskBlock>(&block); trials && trials->name() == name)
      return *trials;
  throw std::out_of_range("there is no block of trials \"" + name + "\"");
}

}  // namespace heft
