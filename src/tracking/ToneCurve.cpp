#include "tracking/ToneCurve.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace heft {

namespace {
constexpr double white = 255;
constexpr double dark_slope = 12.92;
constexpr double dark_light = 0.0031308;

Stored exactly(double light) {
  if (light <= dark_light) return {white * dark_slope * light, white * dark_slope};
  const double power = std::pow(light, 1 / 2.4);
  return {white * (1.055 * power - 0.055), white * 1.055 / 2.4 * power / light};
}

// Value and slope at even steps of light; between them the tangent is off by less than 1/50 level.
constexpr int steps = 4096;
const std::array<Stored, steps + 1> table = [] {
  std::array<Stored, steps + 1> made{};
  for (int i = 0; i <= steps; ++i)
    made[static_cast<std::size_t>(i)] = exactly(static_cast<double>(i) / steps);
  return made;
}();
}  // namespace

Stored stored_of_light(double light) {
  if (light >= 1) return {white, 0};
  if (light <= 0) return {white * dark_slope * light, white * dark_slope};
  const double place = light * steps;
  const int nearest = static_cast<int>(place + 0.5);
  const Stored& there = table[static_cast<std::size_t>(nearest)];
  return {there.value + there.by_light * (place - nearest) / steps, there.by_light};
}

double light_of_stored(double value) {
  const double v = std::clamp(value / white, 0.0, 1.0);
  return v <= dark_slope * dark_light ? v / dark_slope : std::pow((v + 0.055) / 1.055, 2.4);
}

}  // namespace heft
