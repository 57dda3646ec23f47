// Which program this is, exactly, and what time it is in the world.
#pragma once

#include <chrono>
#include <string>

namespace heft {

/// Compiler, machine and the linker's build id: equal names, equal bits.
std::string build_name();

/// ISO 8601 with milliseconds: 2026-11-21T05:54:45.123Z
std::string utc_of(std::chrono::system_clock::time_point time);
std::string utc_now();

/// Seconds from a time as utc_now() gives it until now; negative if it lies ahead.
/// @throws Error when it is no such time
double seconds_since(const std::string& utc);

}  // namespace heft
