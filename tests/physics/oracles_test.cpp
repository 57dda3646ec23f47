#include "physics/scene/Oracles.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace heft {
namespace {

TEST(FreeReturn, CriticalDampingIsTheWellKnownFormula) {
  const FreeReturn x(50, 0.010, 1);
  EXPECT_NEAR(x.omega_rad_s(), 70.7107, 1e-4);
  EXPECT_NEAR(x(0.02), (1 + 1.41421356) * std::exp(-1.41421356), 1e-8);
}

TEST(FreeReturn, UndampedIsACosine) {
  const FreeReturn x(4, 1, 0);
  for (double t_s : {0.0, 0.3, 2.0}) EXPECT_NEAR(x(t_s), std::cos(2 * t_s), 1e-12);
}

RC_GTEST_PROP(FreeReturn, SolvesItsEquationOfMotion, ()) {
  const double z = *rc::gen::inRange(0, 300) / 100.0;
  const double t_s = *rc::gen::inRange(1, 200) / 1000.0;
  const FreeReturn x(50, 0.010, z);
  const double w = x.omega_rad_s(), h = 1e-5;
  const double velocity = (x(t_s + h) - x(t_s - h)) / (2 * h);
  const double acceleration = (x(t_s + h) - 2 * x(t_s) + x(t_s - h)) / (h * h);
  RC_ASSERT(std::abs(acceleration + 2 * z * w * velocity + w * w * x(t_s)) < 1e-4 * w * w);
  RC_ASSERT(std::abs(x(0) - 1) < 1e-12);
  RC_ASSERT(std::abs(x(h) - x(-h)) / (2 * h) < 1e-6 * w);
}

TEST(SteadyLag, IsWhatThePaperAndHandCalculationGive) {
  EXPECT_NEAR(steady_lag_m(0.8, 0.015, 50), 2.3544e-3, 1e-9);
  EXPECT_NEAR(steady_lag_m(0.8, 0.200, 50), 31.392e-3, 1e-9);
  EXPECT_NEAR(steady_lag_m(0.8, 0.800, 50), 125.568e-3, 1e-9);
}

}  // namespace
}  // namespace heft
