#include "base/Clock.h"

#include <fmt/chrono.h>

#include <ctime>
#include <string_view>

#include "base/Error.h"

namespace heft {

namespace {
using Clock = std::chrono::system_clock;
}  // namespace

std::string minutes_text(double seconds) {
  const auto whole_s = static_cast<long>(seconds);
  return fmt::format("{}:{:02}", whole_s / 60, whole_s % 60);
}

std::string utc_of(std::chrono::system_clock::time_point time) {
  // floor also rounds times before 1970 down.
  const auto second = std::chrono::floor<std::chrono::seconds>(time);
  const auto ms = std::chrono::floor<std::chrono::milliseconds>(time - second).count();
  return fmt::format("{:%Y-%m-%dT%H:%M:%S}.{:03}Z", fmt::gmtime(Clock::to_time_t(second)), ms);
}

std::string utc_now() {
  return utc_of(Clock::now());
}

double seconds_since(const std::string& utc) {
  std::tm time{};
  const char* rest = strptime(utc.c_str(), "%Y-%m-%dT%H:%M:%S", &time);
  // Earlier versions wrote times before 1970 with a negative fraction: "59.-250Z".
  const bool counts_down = rest && std::string_view(rest).starts_with(".-");
  const std::string fraction = !rest ? "" : counts_down ? "-." + std::string(rest + 2) : rest;
  char* end = nullptr;
  const double fraction_s = std::strtod(fraction.c_str(), &end);
  if (!rest || std::string_view(end) != "Z")
    throw Error(fmt::format("\"{}\" is not a UTC time, expected YYYY-MM-DDThh:mm:ss.sssZ", utc));
  const double started_s = static_cast<double>(timegm(&time)) + fraction_s;
  return std::chrono::duration<double>(Clock::now().time_since_epoch()).count() - started_s;
}

}  // namespace heft
