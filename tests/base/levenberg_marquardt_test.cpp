// Problems with known answers, most of them from Moré, Garbow and Hillstrom, "Testing unconstrained
// optimization software", ACM TOMS 7, 1981.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/LU>
#include <array>
#include <limits>

#include "base/Random.h"
#include "base/math/LevenbergMarquardt.h"

namespace heft {
namespace {

// Residuals and their derivatives as plain squares.
template <int m, int n, typename Residuals>
struct Problem {
  using Unknowns = Eigen::Matrix<double, n, 1>;
  Residuals residuals;  // (x, r, J)

  NormalEquations<n> at(const Unknowns& x) const {
    Eigen::Matrix<double, m, 1> r;
    Eigen::Matrix<double, m, n> by;
    residuals(x, r, by);
    NormalEquations<n> equations;
    equations.matrix = by.transpose() * by;
    equations.rhs = -by.transpose() * r;
    equations.cost = r.squaredNorm();
    return equations;
  }
  Unknowns solved(Unknowns x, double& cost) const {
    cost = levenberg_marquardt(
               x, 500, 1e-15, [&](const Unknowns& there) { return at(there); },
               [](const Unknowns& from, const Unknowns& step) -> Unknowns { return from + step; })
               .cost;
    return x;
  }
};

template <int m, int n, typename Residuals>
Problem<m, n, Residuals> problem(const Residuals& residuals) {
  return {residuals};
}

TEST(LevenbergMarquardt, FollowsRosenbrocksValley) {
  const auto rosenbrock = problem<2, 2>([](const auto& x, auto& r, auto& by) {
    r << 10 * (x[1] - x[0] * x[0]), 1 - x[0];
    by << -20 * x[0], 10, -1, 0;
  });
  for (const double far : {1.0, 10.0, 100.0}) {
    double cost = 0;
    const auto x = rosenbrock.solved(far * Eigen::Vector2d(-1.2, 1), cost);
    EXPECT_NEAR((x - Eigen::Vector2d(1, 1)).norm(), 0, 1e-5) << far;
  }
}

TEST(LevenbergMarquardt, ComesDownToPowellsSingularPoint) {
  const double root5 = std::sqrt(5.0), root10 = std::sqrt(10.0);
  const auto powell = problem<4, 4>([=](const auto& x, auto& r, auto& by) {
    const double a = x[1] - 2 * x[2], b = x[0] - x[3];
    r << x[0] + 10 * x[1], root5 * (x[2] - x[3]), a * a, root10 * b * b;
    by << 1, 10, 0, 0, 0, 0, root5, -root5, 0, 2 * a, -4 * a, 0, 2 * root10 * b, 0, 0,
        -2 * root10 * b;
  });
  double cost = 0;
  const auto x = powell.solved(Eigen::Vector4d(3, -1, 0, 1), cost);
  EXPECT_LT(cost, 1e-12);
  EXPECT_LT(x.norm(), 0.01);
}

TEST(LevenbergMarquardt, FindsTheResidualOfBardsProblem) {
  constexpr std::array y{0.14, 0.18, 0.22, 0.25, 0.29, 0.32, 0.35, 0.39,
                         0.37, 0.58, 0.73, 0.96, 1.34, 2.10, 4.39};
  const auto bard = problem<15, 3>([&](const auto& x, auto& r, auto& by) {
    for (int i = 0; i < 15; ++i) {
      const double u = i + 1, v = 15 - i, w = std::min(u, v), below = v * x[1] + w * x[2];
      r[i] = y[static_cast<std::size_t>(i)] - (x[0] + u / below);
      by.row(i) << -1, u * v / (below * below), u * w / (below * below);
    }
  });
  double cost = 0;
  const auto x = bard.solved(Eigen::Vector3d(1, 1, 1), cost);
  EXPECT_NEAR(cost, 8.21487e-3, 1e-8);
  EXPECT_NEAR((x - Eigen::Vector3d(0.0824106, 1.1330361, 2.3436952)).norm(), 0, 1e-4);
}

// Huber's cost alone, for an independent solution.
RC_GTEST_PROP(LevenbergMarquardt, ALineIsWhereNoStepAsideCostsLess, (std::uint64_t seed)) {
  RandomStream draws(seed, "line");
  std::array<Eigen::Vector2d, 20> points;
  for (Eigen::Vector2d& point : points) {
    const double x = 10 * draws.uniform();
    point = {x, 3 - 0.5 * x + 0.1 * draws.normal() + (draws.uniform() < 0.15 ? 5 : 0)};
  }
  constexpr double sd = 0.1;
  const auto at = [&](const Eigen::Vector2d& line) {
    NormalEquations<Eigen::Dynamic> equations(2);
    for (const Eigen::Vector2d& point : points) {
      const Eigen::Vector2d by(1, point.x());
      const double residual = by.dot(line) - point.y();
      const RobustResidual robust = huber(std::abs(residual) / sd);
      equations.matrix += robust.weight / (sd * sd) * by * by.transpose();
      equations.rhs -= robust.weight / (sd * sd) * residual * by;
      equations.cost += robust.cost;
      equations.sum_squares += residual * residual;
      ++equations.n;
    }
    return equations;
  };
  Eigen::Vector2d line(draws.normal(), draws.normal());
  const auto moved = [](const Eigen::Vector2d& from, const Eigen::VectorXd& step) {
    return Eigen::Vector2d(from + step);
  };
  // Outliers on one side move it by a hundredth of the way in each step.
  const auto equations = levenberg_marquardt(line, 100000, 1e-14, at, moved);
  RC_ASSERT(equations.cost == at(line).cost);
  for (const Eigen::Vector2d& aside :
       {Eigen::Vector2d(1e-3, 0), Eigen::Vector2d(0, 1e-3), Eigen::Vector2d(1e-3, -2e-4)})
    for (const double sign : {-1.0, 1.0}) RC_ASSERT(at(line + sign * aside).cost >= equations.cost);
  RC_ASSERT(std::abs(equations.rms() - std::sqrt(at(line).sum_squares / 20)) < 1e-12);
}

RC_GTEST_PROP(LevenbergMarquardt, APriorPullsAsAMeasurementOfItsVarianceDoes,
              (std::uint64_t seed)) {
  RandomStream draws(seed, "prior");
  const double measured = draws.normal(), sd = 0.1 + draws.uniform();
  const double known = draws.normal(), known_sd = 0.1 + draws.uniform();
  Eigen::Matrix<double, 1, 1> x;
  x << 10 * draws.normal();
  const auto equations = levenberg_marquardt(
      x, 100, 1e-15,
      [&](const auto& at) {
        NormalEquations<1> both;
        both.add_prior(0, at[0] - measured, sd);
        both.add_prior(0, at[0] - known, known_sd);
        return both;
      },
      [](const auto& from, const auto& step) { return (from + step).eval(); });
  const double weight = 1 / (sd * sd), known_weight = 1 / (known_sd * known_sd);
  const double mean = (weight * measured + known_weight * known) / (weight + known_weight);
  RC_ASSERT(std::abs(x[0] - mean) < 1e-7);
  RC_ASSERT(std::abs(1 / equations.matrix(0, 0) - 1 / (weight + known_weight)) < 1e-12);
}

TEST(LevenbergMarquardt, StaysIfEveryStepLeavesTheDomain) {
  Eigen::Vector2d x(1, 2);
  const auto at = [](const Eigen::Vector2d& there) {
    NormalEquations<2> equations;
    equations.matrix.setIdentity();
    equations.rhs << 1, 1;
    equations.cost = there == Eigen::Vector2d(1, 2) ? 1 : std::numeric_limits<double>::quiet_NaN();
    return equations;
  };
  const auto moved = [](const Eigen::Vector2d& from, const Eigen::Vector2d& step) {
    return Eigen::Vector2d(from + step);
  };
  EXPECT_EQ(levenberg_marquardt(x, 100, 0, at, moved).cost, 1);
  EXPECT_EQ(x, Eigen::Vector2d(1, 2));
}

TEST(Huber, IsASquareWithinAndALineBeyondWithoutAJumpOrABend) {
  EXPECT_EQ(huber(2).cost, 4);
  EXPECT_EQ(huber(2).weight, 1);
  EXPECT_DOUBLE_EQ(huber(10).cost - huber(9).cost, huber(6).cost - huber(5).cost);
  constexpr double step = 1e-6;
  for (const double size : {1.0, 2.5, 7.0}) {  // the weight is half the slope by the size
    const double slope = (huber(size + step).cost - huber(size - step).cost) / (2 * step);
    EXPECT_NEAR(huber(size).weight * size, slope / 2, 1e-5);
  }
}

}  // namespace
}  // namespace heft
