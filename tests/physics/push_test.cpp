// Pushes of one cube: the clone's lag is proportional to friction.
#include <gtest/gtest.h>

#include "physics/Pushes.h"
#include "physics/scene/Oracles.h"

namespace heft {
namespace {

// Slow and long, so that the start has decayed.
const Stroke steady{.speed_m_s = 0.05, .length_m = 0.15};

double lag_m(const Stroke& stroke, const Pose& target, const WorldState& state) {
  return (target.position_m - state.clone.pose.position_m).dot(stroke.direction());
}

double steady_lag_of(const std::string& name, const Scene& scene, const Stroke& stroke = steady) {
  const WorldState state =
      run(*make_simulator(name), scene, along(stroke), stroke.duration_s(), 240);
  return lag_m(stroke, stroke.at(stroke.duration_s()), state);
}

class SteadyLagOf : public testing::TestWithParam<double> {};

TEST_P(SteadyLagOf, LockedIsWithin2PercentOr50Micrometers) {
  const double expected_m = steady_lag_m(0.8, GetParam(), 50);
  EXPECT_NEAR(steady_lag_of("bullet-lx", one_cube(GetParam())), expected_m,
              std::max(0.02 * expected_m, 0.05e-3));
}

TEST_P(SteadyLagOf, OtherSchemesAreWithinHalfAMillimeter) {
  const double expected_m = steady_lag_m(0.8, GetParam(), 50);
  for (const char* name : {"bullet-ea", "bullet-x"})
    EXPECT_NEAR(steady_lag_of(name, one_cube(GetParam())), expected_m, 0.5e-3) << name;
}

TEST_P(SteadyLagOf, IsTheSameInEveryDirection) {
  for (double degrees : {30.0, 45.0, 90.0, 200.0}) {
    Stroke stroke = steady;
    stroke.heading_rad = degrees * M_PI / 180;
    Scene scene = one_cube(GetParam());
    scene.cubes[0].yaw_rad = stroke.heading_rad;
    const double expected_m = steady_lag_m(0.8, GetParam(), 50);
    EXPECT_NEAR(steady_lag_of("bullet", scene, stroke), expected_m,
                std::max(0.02 * expected_m, 0.05e-3))
        << degrees;
  }
}

INSTANTIATE_TEST_SUITE_P(Masses, SteadyLagOf, testing::Values(0.015, 0.200));

TEST(SteadyLag, FollowsFrictionGravityAndStiffness) {
  Scene scene = one_cube(0.2);
  scene.friction = 0.4;
  EXPECT_NEAR(steady_lag_of("bullet", scene), steady_lag_m(0.4, 0.2, 50), 0.3e-3);
  scene.coupling.stiffness_n_per_m = 100;
  EXPECT_NEAR(steady_lag_of("bullet", scene), steady_lag_m(0.4, 0.2, 100), 0.2e-3);
  scene.gravity_m_s2 = 9.81 / 2;
  EXPECT_NEAR(steady_lag_of("bullet", scene), steady_lag_m(0.2, 0.2, 100), 0.1e-3);
}

TEST(SteadyPush, PressesTheCubeWithFrictionsForceAndTheSpringHoldsIt) {
  const auto simulator = make_simulator("bullet");
  const WorldState state = run(*simulator, one_cube(0.2), along(steady), steady.duration_s(), 240);
  ASSERT_EQ(state.contacts.size(), 1u);
  EXPECT_EQ(state.contacts[0].cube, 0);
  const double expected_n = sliding_force_n(0.8, 0.2);
  EXPECT_NEAR(state.contacts[0].force_n.x(), expected_n, 0.02 * expected_n);
  EXPECT_NEAR(state.contacts[0].force_n.y(), 0, 1e-3 * expected_n);
  const double spring_n = 50 * lag_m(steady, steady.at(steady.duration_s()), state);
  EXPECT_NEAR(state.contacts[0].force_n.x(), spring_n, 1e-3 * expected_n);
}

TEST(HeavyCube, DoesNotMoveWithinATenCentimeterStroke) {
  for (const std::string& name : every_solver) {
    for (double rate_hz : {60.0, 240.0}) {
      const Stroke stroke;
      const WorldState state = run(*make_simulator(name), one_cube(0.8), along(stroke),
                                   stroke.duration_s() + 1, rate_hz);
      EXPECT_NEAR(state.cubes[0].pose.position_m.x(), 0, 0.01e-3) << name << ' ' << rate_hz;
      EXPECT_NEAR(lag_m(stroke, stroke.at(2), state), 0.098, 0.02e-3) << name << ' ' << rate_hz;
    }
  }
}

TEST(HeavyCube, DoesNotMoveAtTheCamerasRateEither) {
  const Stroke stroke;
  const WorldState state =
      run(*make_simulator("bullet"), one_cube(0.8), along(stroke), stroke.duration_s() + 1, 15);
  EXPECT_NEAR(state.cubes[0].pose.position_m.x(), 0, 0.01e-3);
}

// The clone must never overlap the cube.
TEST(Push, TheTipStaysAtTheCubesFace) {
  const Stroke stroke{.speed_m_s = 0.3, .length_m = 0.15};
  for (const std::string& name : every_solver) {
    run(*make_simulator(name), one_cube(0.2), along(stroke), stroke.duration_s(), 240,
        [&](double t_s, const Pose&, const WorldState& state) {
          const double gap_m = state.cubes[0].pose.position_m.x() - 0.0175 -
                               (state.clone.pose.position_m.x() + 0.045);
          EXPECT_GE(gap_m, -0.02e-3) << name << " at " << t_s;
        });
  }
}

TEST(Release, ASlidingCubeComesToRestAsFrictionSays) {
  // Thrown at 0.5 m/s by a C1 clone that stops: it slides v^2 / (2 mu g) on.
  Scene scene = one_cube(0.2);
  scene.coupling.decoupled = false;
  const Stroke stroke{.speed_m_s = 0.5, .length_m = 0.1};
  const WorldState state = run(*make_simulator("bullet"), scene, along(stroke), 1.5, 960);
  const double slide_m = 0.5 * 0.5 / (2 * 0.8 * 9.81);
  EXPECT_NEAR(state.cubes[0].pose.position_m.x(), 0.098 + slide_m, 0.5e-3);
  EXPECT_EQ(state.cubes[0].velocity.linear_m_s.norm(), 0);
  EXPECT_TRUE(state.contacts.empty());
}

class CoupledClone : public testing::TestWithParam<double> {};

TEST_P(CoupledClone, StaysOnTheEffectorAndCubesMoveAlikeWhateverTheyWeigh) {
  const Stroke stroke{.speed_m_s = 0.2, .length_m = 0.15, .side_m = GetParam()};
  std::vector<std::vector<Eigen::Vector3d>> paths;
  for (double mass_kg : {0.015, 0.2, 0.8, 1.5}) {
    Scene scene = one_cube(mass_kg);
    scene.coupling.decoupled = false;
    auto& path = paths.emplace_back();
    run(*make_simulator("bullet"), scene, along(stroke), 1.5, 240,
        [&](double, const Pose& target, const WorldState& state) {
          EXPECT_EQ(state.clone.pose.position_m, target.position_m);
          path.push_back(state.cubes[0].pose.position_m);
        });
  }
  double widest_m = 0;
  for (const auto& path : paths)
    for (std::size_t i = 0; i < path.size(); ++i)
      widest_m = std::max(widest_m, (path[i] - paths[0][i]).norm());
  EXPECT_LE(widest_m, 0.1e-3);
  EXPECT_GT(paths[0].back().x(), 0.1);
}

INSTANTIATE_TEST_SUITE_P(Sides, CoupledClone, testing::Values(0.0, 0.004, -0.015));

}  // namespace
}  // namespace heft
