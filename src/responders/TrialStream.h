// The random stream of one attempt at a trial: a trial run again draws the same.
#pragma once

#include "base/Random.h"
#include "responders/Responder.h"

namespace heft {

inline RandomStream trial_stream(std::uint64_t seed, std::string_view purpose,
                                 const TrialView& trial) {
  return {seed, purpose, static_cast<std::uint64_t>(trial.trial_number),
          static_cast<std::uint64_t>(trial.attempt)};
}

}  // namespace heft
