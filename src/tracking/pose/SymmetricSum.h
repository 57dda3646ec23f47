// Sums of symmetric products, of which only one half is computed: the most expensive part of least
// squares.
#pragma once

#include <Eigen/Core>

namespace heft {

/// Adds the lower half of a b^T, which is symmetric.
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
