// The normal distribution function and its density by table lookup.
#pragma once

#include <array>
#include <cstddef>

namespace heft {

struct Normal {
  double below, density;
};

// Values with their first and second derivatives at even steps.
inline constexpr double normal_end = 5, normal_steps_per_unit = 64;
using NormalTable =
    std::array<Normal, static_cast<std::size_t>(2 * normal_end * normal_steps_per_unit) + 1>;
extern const NormalTable normal_table;

/// Accurate to 1e-5. Called some hundred thousand times per picture.
inline Normal normal_at(double x) {
  if (x <= -normal_end) return {0, 0};
  if (x >= normal_end) return {1, 0};
  const double place = (x + normal_end) * normal_steps_per_unit;
  const auto nearest = static_cast<std::size_t>(place + 0.5);
  const double rest = (place - static_cast<double>(nearest)) / normal_steps_per_unit;
  const Normal& there = normal_table[nearest];
  return {there.below + there.density * rest, there.density * (1 - x * rest)};
}

}  // namespace heft
