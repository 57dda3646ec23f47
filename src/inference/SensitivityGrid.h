// Sensitivities on a grid, on which each person's likelihood is known: see PooledSensitivity.h.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>

namespace heft {

/// Sensitivities per largest level: dense around 0, and up to thresholds of a four-hundredth of it.
inline constexpr std::size_t n_grid = 56;
inline constexpr std::size_t no_sensitivity = 20;  ///< the place of 0
inline double sensitivity_at(double place) {
  constexpr double place_step = 0.2;
  return 0.5 * std::sinh(place_step * (place - static_cast<double>(no_sensitivity)));
}

/// A figure at each place, mostly a log likelihood.
using OnGrid = std::array<double, n_grid>;

/// Each person as often as `times` says.
OnGrid sum_of(std::span<const OnGrid> people, std::span<const double> times);

/// The place where a sum is highest, by the parabola through the three highest.
double top_of(const OnGrid& sum);

double between_places(const OnGrid& values, double place);

}  // namespace heft
