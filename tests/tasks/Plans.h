// The trials of a block whose plans do not depend on the answers.
#pragma once

#include <cstdint>
#include <vector>

#include "tasks/TaskRun.h"

namespace heft::testing {

template <typename Block>
std::vector<TrialPlan> plans(const Block& block, std::uint64_t seed, int attempt = 1) {
  typename Block::OfTask::Run run(block, seed);
  std::vector<TrialPlan> plans;
  while (!run.finished()) {
    plans.push_back(run.plan({seed, static_cast<int>(plans.size()) + 1, attempt}));
    Changes changes;
    run.complete({}, changes);
  }
  return plans;
}

}  // namespace heft::testing
