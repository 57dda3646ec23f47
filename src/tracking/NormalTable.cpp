#include "tracking/NormalTable.h"

#include <array>
#include <cmath>
#include <numbers>

namespace heft {

namespace {
// Value, first and second order.
constexpr double normal_end = 5, normal_steps_per_unit = 64;
const std::array<Normal, static_cast<std::size_t>(2 * normal_end * normal_steps_per_unit) + 1>
    normal_table = [] {
      std::array<Normal, static_cast<std::size_t>(2 * normal_end * normal_steps_per_unit) + 1>
          made{};
      for (std::size_t i = 0; i < made.size(); ++i) {
        const double x = static_cast<double>(i) / normal_steps_per_unit - normal_end;
        made[i] = {0.5 * std::erfc(-x / std::numbers::sqrt2),
                   std::exp(-x * x / 2) / std::sqrt(2 * std::numbers::pi)};
      }
      return made;
    }();
}  // namespace

Normal normal_at(double x) {
  if (x <= -normal_end) return {0, 0};
  if (x >= normal_end) return {1, 0};
  const double place = (x + normal_end) * normal_steps_per_unit;
  const auto nearest = static_cast<std::size_t>(place + 0.5);
  const double rest = (place - static_cast<double>(nearest)) / normal_steps_per_unit;
  const Normal& there = normal_table[nearest];
  return {there.below + there.density * rest, there.density * (1 - x * rest)};
}

}  // namespace heft
