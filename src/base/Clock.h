// The machine's monotonic clock: the one that V4L2 stamps pictures with and that the session's wall
// clock is anchored to. Only cameras, windows and the session's runner look at it.
#pragma once

#include <chrono>

namespace heft {

/// Seconds of the monotonic clock (CLOCK_MONOTONIC); where it starts means nothing.
inline double monotonic_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace heft
