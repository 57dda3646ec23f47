// The inner loops of fits to edges and tags: the normal distribution by table lookup, and sums of
// symmetric products, of which only one half is computed.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace heft {

struct Normal {
  double below, density;
};

// Values with their first and second derivatives at even steps.
inline constexpr double normal_end = 5, normal_steps_per_unit = 64;
using NormalTable =
    std::array<Normal, static_cast<std::size_t>(2 * normal_end * normal_steps_per_unit) + 1>;
inline const NormalTable normal_table = [] {
  NormalTable made{};
  for (std::size_t i = 0; i < made.size(); ++i) {
    const double x = static_cast<double>(i) / normal_steps_per_unit - normal_end;
    made[i] = {0.5 * std::erfc(-x / std::numbers::sqrt2),
               std::exp(-x * x / 2) / std::sqrt(2 * std::numbers::pi)};
  }
  return made;
}();

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

/// Adds the lower half of a b^T, which is symmetric: the most expensive part of least squares.
template <int n>
void add_lower(Eigen::Matrix<double, n, n>& sum, const Eigen::Matrix<double, n, 1>& a,
               const Eigen::Matrix<double, n, 1>& b) {
  for (int column = 0; column < n; ++column)
    for (int row = column; row < n; ++row) sum(row, column) += a(row) * b(column);
}

/// Copies the lower half to the upper one, after all additions.
template <int n>
void complete_upper(Eigen::Matrix<double, n, n>& sum) {
  sum.template triangularView<Eigen::StrictlyUpper>() = sum.transpose();
}

}  // namespace heft
