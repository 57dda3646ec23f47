// The machine's monotonic clock, and the calendar's time as text.
#pragma once

#include <chrono>
#include <string>

namespace heft {

/// Seconds of the monotonic clock (CLOCK_MONOTONIC); where it starts means nothing.
inline double monotonic_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// ISO 8601 with milliseconds: 2026-11-21T05:54:45.123Z
std::string utc_of(std::chrono::system_clock::time_point time);
std::string utc_now();

/// Seconds from a time as utc_now() gives it until now; negative if it lies ahead.
/// @throws Error when it is no such time
double seconds_since(const std::string& utc);

}  // namespace heft
