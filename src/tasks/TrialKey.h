// Which attempt at which trial of the session is meant: what its random streams are keyed by, so
// that a void attempt redraws its own arrangement and nothing else.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "base/Random.h"
#include "experiment/TrialPlan.h"

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

}  // namespace heft
