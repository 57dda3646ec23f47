// The techniques that displace the clone from the hand, against their closed forms.
#include <gmock/gmock.h>

#include "physics/Drive.h"
#include "physics/Pushes.h"
#include "physics/scene/Oracles.h"

namespace heft {
namespace {

const MassCurve gains({{0.015, 0.95}, {0.2, 0.6}, {0.8, 0.2}});
const MassCurve limits_m_s({{0.015, 0.3}, {0.2, 0.05}, {0.8, 0.01}});
const std::vector<std::string> every_kind{"boxes", "bullet-lx", "push", "quasi_static"};
constexpr double gap_m = 2e-3;  // from the tip to the cube at the start

Scene scene_with(const Displacement& displacement, double mass_kg = 0.2) {
  Scene scene = one_cube(mass_kg);
  scene.coupling.decoupled = false;
  scene.displacement = displacement;
  return scene;
}

template <typename Path, typename See>
WorldState drive(const std::string& simulator, const Scene& scene, const Path& path, double until_s,
                 double rate_hz, const See& see) {
  Drive drive(make_simulator(simulator), scene, rate_hz);
  const int n = static_cast<int>(std::lround(until_s * rate_hz));
  for (int i = 0; i <= n; ++i)
    see(i / rate_hz, path(i / rate_hz), drive.advance(sample_of(i / rate_hz, path(i / rate_hz))));
  return drive.state();
}

template <typename Path>
WorldState drive(const std::string& simulator, const Scene& scene, const Path& path, double until_s,
                 double rate_hz = 240) {
  return drive(simulator, scene, path, until_s, rate_hz, [](double, const auto&, const auto&) {});
}

double behind_m(const Pose& hand, const WorldState& state) {
  return hand.position_m.x() - state.clone.pose.position_m.x();
}

TEST(MassCurve, InterpolatesOverTheLogarithmOfMass) {
  EXPECT_DOUBLE_EQ(gains.at(0.2), 0.6);
  EXPECT_DOUBLE_EQ(gains.at(std::sqrt(0.2 * 0.8)), 0.4);
  EXPECT_DOUBLE_EQ(gains.at(0.001), 0.95);
  EXPECT_DOUBLE_EQ(gains.at(5), 0.2);
  EXPECT_DOUBLE_EQ(MassCurve({{0.1, 0.7}}).at(0.3), 0.7);
}

TEST(Gain, ShowsItsShareOfTheHandsWayOnceTheCloneTouches) {
  const Stroke stroke{.height_m = 0.0205};
  for (const std::string& name : every_kind)
    for (double rate_hz : {15.0, 60.0, 240.0})
      drive(name, scene_with(Gain{gains}), along(stroke), stroke.duration_s(), rate_hz,
            [&](double t_s, const Pose& hand, const WorldState& state) {
              const double pushed_m = std::max(0.0, t_s * stroke.speed_m_s - gap_m);
              EXPECT_NEAR(behind_m(hand, state), 0.4 * pushed_m, 0.02e-3) << name << ' ' << t_s;
              EXPECT_NEAR(state.cubes[0].pose.position_m.x(), 0.6 * pushed_m, 0.05e-3) << name;
            });
}

TEST(Gain, IsThatOfAllCubesThatAreTouched) {
  Scene scene = scene_with(Gain{gains}, 0.1);
  scene.cubes = {cube_of(0.1, 0, -0.019), cube_of(0.1, 0, 0.019)};
  const Stroke stroke{.length_m = 0.05};
  const WorldState state = drive("boxes", scene, along(stroke), stroke.duration_s());
  EXPECT_NEAR(behind_m(stroke.at(1), state), 0.4 * (0.05 - gap_m), 0.05e-3);
}

// In by 5 cm within half a second and back, too slowly to throw a cube.
double way_in_m(double t_s) {
  return 0.025 * (1 - std::cos(2 * M_PI * t_s));
}
Pose in_and_back(double t_s) {
  return Stroke{.speed_m_s = 1, .length_m = 1}.at(way_in_m(t_s));
}

TEST(Gain, ReturnsCriticallyDampedOnceTheHandHasLeftTheCube) {
  const double in_m = 0.05 - gap_m, g = 0.6, return_s = 0.08;
  const double out_m = gap_m + g * in_m;  // where the hand leaves the pushed cube
  const double left_s = 1 - std::acos(1 - out_m / 0.025) / (2 * M_PI);
  const FreeReturn back(1 / (return_s * return_s), 1, 1);
  for (const std::string& name : every_solver)
    drive(name, scene_with(Gain{gains, return_s}), in_and_back, 0.95, 240,
          [&](double t_s, const Pose& hand, const WorldState& state) {
            if (t_s < 0.5) return;
            const double touching_m = (1 - g) * (way_in_m(t_s) - gap_m);
            const double expected_m =
                t_s < left_s ? touching_m : (1 - g) * (out_m - gap_m) * back(t_s - left_s);
            EXPECT_NEAR(state.cubes[0].pose.position_m.x(), g * in_m, 0.05e-3) << name << t_s;
            EXPECT_NEAR(behind_m(hand, state), expected_m, 0.05e-3) << name << ' ' << t_s;
          });
}

// A hand passes through a heavy cube and returns: the clone must not follow it through the cube.
TEST(Gain, DoesNotKickACubeThatTheHandHasPassed) {
  const auto deep = [](double t_s) {
    return Stroke{.speed_m_s = 1, .length_m = 1}.at(0.09 * (1 - std::cos(M_PI * t_s)));
  };
  for (double rate_hz : {15.0, 60.0, 240.0})
    drive("boxes", scene_with(Gain{gains}, 0.8), deep, 2, rate_hz,
          [&](double t_s, const Pose&, const WorldState& state) {
            EXPECT_LE(state.cubes[0].pose.position_m.x(), 0.2 * 0.18) << rate_hz << ' ' << t_s;
            EXPECT_LT(state.cubes[0].velocity.linear_m_s.norm(), 0.1) << rate_hz << ' ' << t_s;
          });
}

TEST(SpeedLimit, HoldsTheCloneBackFromTheFirstTouchAndLetsItCatchUp) {
  const Stroke stroke{.length_m = 0.05, .height_m = 0.0205};
  const double touch_s = gap_m / stroke.speed_m_s, limit_m_s = 0.05;
  for (const std::string& name : every_kind)
    for (double rate_hz : {15.0, 60.0, 240.0})
      drive(name, scene_with(SpeedLimit{limits_m_s}), along(stroke), 1.2, rate_hz,
            [&](double t_s, const Pose& hand, const WorldState& state) {
              const double hand_m = std::min(t_s * stroke.speed_m_s, stroke.length_m);
              const double clone_m = gap_m + limit_m_s * (t_s - touch_s);
              const double expected_m = t_s < touch_s ? 0 : std::max(0.0, hand_m - clone_m);
              EXPECT_NEAR(behind_m(hand, state), expected_m, 0.02e-3)
                  << name << ' ' << rate_hz << ' ' << t_s;
            });
}

// The clone moves at the limit until it reaches a hand that waits, and throws the cube at that
// speed.
TEST(SpeedLimit, HoldsUntilTheCloneHasCaughtUp) {
  const double limit_m_s = 0.15, slides_m = limit_m_s * limit_m_s / (2 * 0.8 * 9.81);
  const Scene scene = scene_with(SpeedLimit{MassCurve({{0.2, limit_m_s}})});
  for (double length_m : {0.05, 0.0508, 0.0511})
    for (double rate_hz : {15.0, 60.0, 240.0}) {
      const Stroke stroke{.speed_m_s = 0.3, .length_m = length_m};
      const WorldState state = drive("boxes", scene, along(stroke), 0.8, rate_hz);
      EXPECT_NEAR(state.cubes[0].pose.position_m.x(), length_m - gap_m + slides_m, 0.01e-3)
          << length_m << " m, " << rate_hz << " Hz";
    }
}

TEST(SpeedLimit, LeavesASlowHandAlone) {
  const Stroke stroke{.speed_m_s = 0.04};
  drive("boxes", scene_with(SpeedLimit{limits_m_s}), along(stroke), 2, 60,
        [&](double, const Pose& hand, const WorldState& state) {
          EXPECT_NEAR(behind_m(hand, state), 0, 1e-9);
        });
}

class Displaced : public testing::TestWithParam<Displacement> {};

TEST_P(Displaced, IsTheHandItselfWhereNothingIsTouched) {
  const auto past = [](double t_s) { return upright_pose({-0.2 + 0.4 * t_s, 0.1, 0.021}, t_s); };
  drive("boxes", scene_with(GetParam()), past, 1, 60,
        [&](double, const Pose& hand, const WorldState& state) {
          EXPECT_EQ(state.clone.pose.position_m, hand.position_m);
          EXPECT_TRUE(state.clone.pose.orientation.isApprox(hand.orientation, 1e-12));
        });
}

TEST_P(Displaced, IsEqualForMassesOfEqualTableValues) {
  const MassCurve flat({{0.2, 0.1}});
  Displacement displacement = GetParam();
  std::visit([&](auto& law) { law.of_mass = flat; }, displacement);
  const auto swing = [](double t_s) {
    return upright_pose({-0.02 + 0.08 * std::sin(4 * t_s), 0.01, 0.021}, 0.3 * std::sin(9 * t_s));
  };
  std::vector<WorldState> ends;
  for (double mass_kg : {0.015, 0.2, 1.5}) {
    Scene scene = scene_with(displacement, mass_kg);
    scene.cubes[0].position_m.x() = 0.06;
    scene.coupling.stiffness_n_per_m *= 1 + mass_kg;  // has no effect without a spring
    ends.push_back(drive("boxes", scene, swing, 1.2, 60));
  }
  for (const WorldState& end : ends) {
    EXPECT_LT((end.clone.pose.position_m - ends[0].clone.pose.position_m).norm(), 1e-9);
    EXPECT_LT((end.cubes[0].pose.position_m - ends[0].cubes[0].pose.position_m).norm(), 1e-9);
  }
  EXPECT_GT(ends[0].cubes[0].pose.position_m.x(), 0.061);
}

TEST_P(Displaced, NoticesACubeOnTheWayOfAFastHandAtACamerasRate) {
  const Stroke stroke{.speed_m_s = 1, .length_m = 0.3};
  const double slow_m = stroke.length_m - 0.0645;
  const auto end_at = [&](double rate_hz) {
    const WorldState state =
        drive("boxes", scene_with(GetParam(), 0.8), along(stroke), 0.2, rate_hz);
    return state.clone.pose.position_m.x();
  };
  EXPECT_NEAR(end_at(15), end_at(480), 0.5e-3);
  EXPECT_LT(end_at(15), slow_m - 0.05);
}

TEST_P(Displaced, StartsAgainAfterAJump) {
  const Stroke stroke;
  Drive drive(make_simulator("boxes"), scene_with(GetParam()), 240);
  for (int i = 0; i <= 12; ++i) drive.advance(sample_of(i / 15.0, stroke.at(i / 15.0)));
  EXPECT_GT(behind_m(stroke.at(0.8), drive.state()), 0.02);
  TargetSample away = sample_of(13 / 15.0, upright_pose({-0.2, 0, 0.021}, 0));
  away.jump = true;
  EXPECT_EQ(drive.advance(away).clone.pose.position_m, away.pose.position_m);
  drive.return_cube(0);
  EXPECT_EQ(drive.state().cubes[0].pose.position_m.x(), 0);
}

TEST_P(Displaced, RunsTheSameTwiceToTheLastBit) {
  const auto hash = [&] {
    return state_hash(drive("boxes", scene_with(GetParam()), in_and_back, 1.2, 60));
  };
  EXPECT_EQ(hash(), hash());
}

INSTANTIATE_TEST_SUITE_P(Techniques, Displaced,
                         testing::Values(Displacement{Gain{gains}},
                                         Displacement{SpeedLimit{limits_m_s}}));

}  // namespace
}  // namespace heft
