// The search for maxima and profiles of functions with known ones.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "inference/MaximumLikelihood.h"

namespace heft {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Normal around (1, 2), with SDs 1 and 2 and a correlation of .6; counts its evaluations.
struct Normal {
  double operator()(const Parameters& at, Derivatives* derivatives) {
    ++n_asked;
    const Eigen::Vector2d off(at[0] - 1, at[1] - 2);
    Eigen::Matrix2d covariance;
    covariance << 1, 1.2, 1.2, 4;
    const Eigen::Matrix2d bend = covariance.inverse();
    if (derivatives) *derivatives = {Parameters(-bend * off), Curvature(-bend)};
    return -off.dot(bend * off) / 2;
  }
  int n_asked = 0;
};

LikelihoodFit fit(Normal& normal, const std::vector<ParameterBounds>& bounds) {
  return maximize_likelihood(std::ref(normal), bounds, {{Parameters(Eigen::Vector2d(5, -5))}});
}

TEST(MaximumLikelihood, OfANormalIsItsOwn) {
  Normal normal;
  const LikelihoodFit found = fit(normal, {{-infinity, infinity}, {-infinity, infinity}});
  const double reach = std::sqrt(2 * interval_drop);
  for (const auto& [i, center, sd] : {std::tuple{0, 1.0, 1.0}, std::tuple{1, 2.0, 2.0}}) {
    const LikelihoodParameter& parameter = found.parameters[static_cast<std::size_t>(i)];
    EXPECT_NEAR(parameter.value, center, 1e-9);
    EXPECT_NEAR(parameter.se.value(), sd, 1e-9);
    EXPECT_NEAR(parameter.low.value(), center - reach * sd, 1e-5 * sd);
    EXPECT_NEAR(parameter.high.value(), center + reach * sd, 1e-5 * sd);
  }
  EXPECT_LE(normal.n_asked, 60) << "a Newton's step is exact here";
}

TEST(MaximumLikelihood, AtABoundTheOthersGiveWay) {
  Normal normal;
  const LikelihoodFit found = fit(normal, {{-infinity, infinity}, {3, infinity}});
  EXPECT_NEAR(found.parameters[0].value, 1.3, 1e-9);  // 1 + 1.2 / 4
  EXPECT_EQ(found.parameters[1].value, 3);
  EXPECT_EQ(found.parameters[1].low, 3);
  EXPECT_FALSE(found.parameters[1].se.has_value());
  EXPECT_NEAR(found.log_likelihood, -1.0 / 8, 1e-12);
}

// Two local maxima, of which the second is higher, and a curved ridge between them.
double two_hills(const Parameters& at, Derivatives* derivatives) {
  const double x = at[0];
  const double first = std::exp(-(x + 2) * (x + 2) / 2),
               second = 3 * std::exp(-(x - 2) * (x - 2) / 2);
  const double slope = -(x + 2) * first - (x - 2) * second, sum = first + second;
  const double bend = ((x + 2) * (x + 2) - 1) * first + ((x - 2) * (x - 2) - 1) * second;
  if (derivatives) {
    derivatives->gradient[0] = slope / sum;
    derivatives->hessian(0, 0) = bend / sum - slope * slope / (sum * sum);
  }
  return std::log(sum);
}

TEST(MaximumLikelihood, WhereItBendsUpwardsTheWayIsStillUp) {
  for (const double start : {-0.3, 0.1, 0.9}) {
    const LikelihoodFit found =
        maximize_likelihood(two_hills, {{-infinity, infinity}},
                            {{Parameters::Constant(1, start)}, {Parameters::Constant(1, 1)}});
    EXPECT_NEAR(found.parameters[0].value, 2, 0.01);
    EXPECT_NEAR(found.log_likelihood, std::log(3), 0.001);
  }
}

}  // namespace
}  // namespace heft
