// Robust nonlinear least squares (Levenberg 1944; Marquardt, "An algorithm for least-squares
// estimation of nonlinear parameters", J. SIAM 11, 1963). With residuals r_i of variance v_i, their
// Jacobians J_i and robust weights w_i, each iteration solves
//
//   (A + damping diag(A)) step = -sum w_i / v_i J_i^T r_i,   A = sum w_i / v_i J_i^T J_i
//
// A step that does not increase the cost is accepted and damping falls tenfold (towards the
// Gauss-Newton step); otherwise damping rises tenfold (towards a short step of steepest descent).
#pragma once

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>

namespace heft {

/// Weight and cost of a residual in standard deviations: quadratic up to 2.5, linear beyond (Huber,
/// "Robust estimation of a location parameter", 1964).
struct RobustResidual {
  double weight, cost;
};

inline RobustResidual huber(double deviations) {
  constexpr double limit = 2.5;
  if (deviations > limit) return {limit / deviations, limit * (2 * deviations - limit)};
  return {1, deviations * deviations};
}

/// A, the right-hand side and the cost at one point.
/// @tparam size number of unknowns, or Eigen::Dynamic
template <int size>
struct NormalEquations {
  Eigen::Matrix<double, size, size> matrix;
  Eigen::Matrix<double, size, 1> rhs;
  double cost = 0;         ///< dimensionless, in variances
  double sum_squares = 0;  ///< of the residuals, in their unit squared
  int n = 0;               ///< number of residuals

  explicit NormalEquations(Eigen::Index n_unknowns = size)
      : matrix(decltype(matrix)::Zero(n_unknowns, n_unknowns)),
        rhs(decltype(rhs)::Zero(n_unknowns)) {}

  double rms() const { return std::sqrt(sum_squares / std::max(1, n)); }

  /// Adds a normal prior of one unknown, `off` from its mean. Counts in the cost, not in rms().
  void add_prior(Eigen::Index unknown, double off, double sd) {
    const double deviations = off / sd;
    matrix(unknown, unknown) += 1 / (sd * sd);
    rhs(unknown) -= deviations / sd;
    cost += deviations * deviations;
  }
};

/// Minimizes the cost until a step gains at most tolerance * (1 + cost), damping exceeds its limit,
/// or max_steps were tried.
/// @param at the start, replaced by the minimum
/// @param equations_at (unknowns): NormalEquations, with infinite cost outside the domain
/// @param moved (unknowns, step): the unknowns after the step
/// @return the equations at the minimum
template <typename Unknowns, typename EquationsAt, typename Moved>
auto levenberg_marquardt(Unknowns& at, int max_steps, double tolerance,
                         const EquationsAt& equations_at, const Moved& moved) {
  constexpr double first_damping = 1e-4, min_damping = 1e-9, max_damping = 1e8;
  auto equations = equations_at(at);
  double damping = first_damping;
  for (int i = 0; i < max_steps && damping < max_damping; ++i) {
    auto damped = equations.matrix;
    damped.diagonal() *= 1 + damping;
    Unknowns next_at = moved(at, damped.ldlt().solve(equations.rhs).eval());
    auto next = equations_at(next_at);
    if (!(next.cost <= equations.cost)) {
      damping *= 10;
      continue;
    }
    const double gained = equations.cost - next.cost;
    at = std::move(next_at);
    equations = std::move(next);
    damping = std::max(damping / 10, min_damping);
    if (gained <= tolerance * (1 + equations.cost)) break;
  }
  return equations;
}

}  // namespace heft
