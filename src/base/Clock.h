// The monotonic clock of the machine, UTC times and durations as text.
#pragma once

#include <chrono>
#include <string>

namespace heft {

/// Seconds of CLOCK_MONOTONIC, which also stamps the pictures of V4L2 cameras. The zero is
/// arbitrary.
inline double monotonic_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Minutes and seconds, e.g. 1:05; fractions of a second are cut off.
std::string minutes_text(double seconds);

/// ISO 8601 with milliseconds, e.g. 2026-11-21T05:54:45.123Z
std::string utc_of(std::chrono::system_clock::time_point time);
std::string utc_now();

/// Seconds from a time in the format of utc_now() until now; negative for a time in the future.
/// @throws Error when the text has another format
double seconds_since(const std::string& utc);

}  // namespace heft
