// The unknowns with the smallest cost near a start (Levenberg 1944; Marquardt, "An algorithm for
// least-squares estimation of nonlinear parameters", J. SIAM 11, 1963). With residuals r_i of
// variance v_i, their derivatives J_i by a step of the unknowns and robust weights w_i, a step is
//
//   (A + damping diag(A)) step = -sum w_i / v_i J_i^T r_i,   A = sum w_i / v_i J_i^T J_i
//
// It is taken if the cost does not grow; then damping falls tenfold, towards Gauss and Newton's
// step, and otherwise rises tenfold, towards a short one straight down.
#pragma once

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>

namespace heft {

/// What a residual of so many standard deviations weighs and costs: squares up to 2.5 of them, from
/// there on lines (Huber, "Robust estimation of a location parameter", 1964).
struct RobustResidual {
  double weight, cost;
};

inline RobustResidual huber(double deviations) {
  constexpr double bend = 2.5;
  if (deviations > bend) return {bend / deviations, bend * (2 * deviations - bend)};
  return {1, deviations * deviations};
}

/// The law's matrix and right side, and the cost, at one place. @tparam size or Eigen::Dynamic
template <int size>
struct NormalEquations {
  Eigen::Matrix<double, size, size> matrix;
  Eigen::Matrix<double, size, 1> rhs;
  double cost = 0;         ///< in variances
  double sum_squares = 0;  ///< of residuals, in their own unit
  int n = 0;               ///< residuals

  explicit NormalEquations(Eigen::Index n_unknowns = size)
      : matrix(decltype(matrix)::Zero(n_unknowns, n_unknowns)),
        rhs(decltype(rhs)::Zero(n_unknowns)) {}

  double rms() const { return std::sqrt(sum_squares / std::max(1, n)); }

  /// What was known of an unknown before: it is off by so much. No residual, costs only.
  void add_prior(Eigen::Index unknown, double off, double sd) {
    const double deviations = off / sd;
    matrix(unknown, unknown) += 1 / (sd * sd);
    rhs(unknown) -= deviations / sd;
    cost += deviations * deviations;
  }
};

/// Moves the unknowns until a step gains no more than settled * (1 + cost), no step gains anything,
/// or most_steps were tried.
/// @param equations_at (unknowns): NormalEquations; an infinite cost where there are none
/// @param moved (unknowns, step): where the step leads
/// @return the equations where it ended
template <typename Unknowns, typename EquationsAt, typename Moved>
auto levenberg_marquardt(Unknowns& at, int most_steps, double settled,
                         const EquationsAt& equations_at, const Moved& moved) {
  constexpr double first_damping = 1e-4, least_damping = 1e-9, most_damping = 1e8;
  auto equations = equations_at(at);
  double damping = first_damping;
  for (int i = 0; i < most_steps && damping < most_damping; ++i) {
    auto damped = equations.matrix;
    damped.diagonal() *= 1 + damping;
    Unknowns there = moved(at, damped.ldlt().solve(equations.rhs).eval());
    auto next = equations_at(there);
    if (!(next.cost <= equations.cost)) {
      damping *= 10;
      continue;
    }
    const double gained = equations.cost - next.cost;
    at = std::move(there);
    equations = std::move(next);
    damping = std::max(damping / 10, least_damping);
    if (gained <= settled * (1 + equations.cost)) break;
  }
  return equations;
}

}  // namespace heft
