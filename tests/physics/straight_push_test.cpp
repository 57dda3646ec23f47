// `push` and `quasi_static`: closed forms, agreement with `boxes` at tiny steps, and what they
// refuse.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "base/Pose.h"
#include "physics/ContactScenes.h"
#include "physics/push/Oscillation.h"
#include "physics/scene/Oracles.h"

namespace heft {
namespace {

using contact_scenes::smooth_push;
using contact_scenes::turned;

// The same polyline for any simulator and step: the hand's poses at a rate of `poses_hz`.
auto polyline(const std::function<Pose(double)>& path, double poses_hz) {
  return [=](double t_s) {
    const double i = std::floor(t_s * poses_hz + 1e-9), rest = t_s * poses_hz - i;
    if (rest < 1e-9) return path(i / poses_hz);
    return interpolate(path(i / poses_hz), path((i + 1) / poses_hz), rest);
  };
}

RC_GTEST_PROP(Oscillation, IsTheFreeReturnAndComposes, ()) {
  const double z = *rc::gen::inRange(10, 400) / 100.0, k = 50, m = 0.01;
  const Oscillation oscillation(m, z * 2 * std::sqrt(k * m), k);
  const double t_s = *rc::gen::inRange(1, 300) / 1000.0;
  const auto once = oscillation.after(t_s, 1, 0);
  RC_ASSERT(std::abs(once.y - FreeReturn(k, m, z)(t_s)) < 1e-9);
  const auto half = oscillation.after(t_s / 2, 1, 0);
  const auto twice = oscillation.after(t_s / 2, half.y, half.speed);
  RC_ASSERT(std::abs(once.y - twice.y) < 1e-12);
  RC_ASSERT(std::abs(once.speed - twice.speed) < 1e-9);
}

class PushAgainstBoxes : public testing::TestWithParam<double> {};

// Two independent methods; `boxes` at a step of 65 microseconds.
TEST_P(PushAgainstBoxes, AgreesWithinAFewMicrometers) {
  for (bool decoupled : {true, false}) {
    for (double damping : {0.5, 1.0, 1.6}) {
      Scene scene = turned(one_cube(GetParam()), 0.7);
      scene.coupling.decoupled = decoupled;
      scene.coupling.damping_ratio = damping;
      const auto path = polyline(smooth_push(0.12, 0.9, 0.7), 30);
      std::vector<Eigen::Vector3d> exact_m;
      run(*make_simulator("push"), scene, path, 1.2, 30,
          [&](double, const Pose&, const WorldState& state) {
            exact_m.push_back(state.clone.pose.position_m);
            exact_m.push_back(state.cubes[0].pose.position_m);
          });
      std::size_t i = 0;
      int n = 0;
      run(*make_simulator("boxes"), scene, path, 1.2, 15360,
          [&](double t_s, const Pose&, const WorldState& state) {
            if (++n % 512 != 0) return;
            EXPECT_LT((state.clone.pose.position_m - exact_m[i++]).norm(), 5e-6) << t_s;
            EXPECT_LT((state.cubes[0].pose.position_m - exact_m[i++]).norm(), 5e-6) << t_s;
          });
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Masses, PushAgainstBoxes, testing::Values(0.015, 0.2, 0.8));

TEST(Push, IsTheSameHoweverASteadyStrokeIsCutIntoSteps) {
  const Stroke stroke{.speed_m_s = 0.1, .length_m = 100};
  const WorldState coarse = run(*make_simulator("push"), one_cube(0.2), along(stroke), 1.2, 15);
  const WorldState fine = run(*make_simulator("push"), one_cube(0.2), along(stroke), 1.2, 1000);
  EXPECT_LT((coarse.clone.pose.position_m - fine.clone.pose.position_m).norm(), 1e-9);
  EXPECT_LT((coarse.cubes[0].pose.position_m - fine.cubes[0].pose.position_m).norm(), 1e-9);
}

TEST(Push, SettlesAtTheLagAndReportsFrictionsForce) {
  const Stroke stroke{.speed_m_s = 0.1, .length_m = 100};
  for (const std::string& name : every_straight_one) {
    const WorldState state = run(*make_simulator(name), one_cube(0.2), along(stroke), 6, 15);
    const double lag_m = stroke.at(6).position_m.x() - state.clone.pose.position_m.x();
    EXPECT_NEAR(lag_m, steady_lag_m(0.8, 0.2, 50), 1e-7) << name;
    ASSERT_EQ(state.contacts.size(), 1u) << name;
    EXPECT_NEAR(state.contacts[0].force_n.x(), sliding_force_n(0.8, 0.2), 1e-5) << name;
  }
}

TEST(Push, AFreeCloneReturnsAsTheClosedFormSays) {
  Scene scene;
  scene.clone_offset.position_m = {0.03, 0, 0};
  const FreeReturn left(50, 0.010, 1);
  run(
      *make_simulator("push"), scene,
      [](double) {
        return upright_pose({0, 0, 0.2}, 0);
      },
      0.3, 40,
      [&](double t_s, const Pose&, const WorldState& state) {
        EXPECT_NEAR(state.clone.pose.position_m.x(), 0.03 * left(t_s), 1e-12);
      });
}

TEST(Push, AThrownCubeSlidesOnAndStops) {
  Scene scene = one_cube(0.2);
  scene.coupling.decoupled = false;
  const Stroke stroke{.speed_m_s = 0.5, .length_m = 0.1};
  const WorldState state = run(*make_simulator("push"), scene, along(stroke), 0.6, 50);
  EXPECT_NEAR(state.cubes[0].pose.position_m.x(), 0.098 + 0.25 / (2 * 0.8 * 9.81), 1e-9);
}

std::string refusal(const std::string& name, const Scene& scene,
                    const std::function<Pose(double)>& path) {
  try {
    run(*make_simulator(name), scene, path, 1.5, 60);
  } catch (const OutsideModel& error) {
    return error.what();
  }
  return "";
}

TEST(StraightStroke, RefusesWhatItCannotRepresentAndSaysWhy) {
  Scene two = one_cube(0.2);
  two.cubes.push_back(cube_of(0.2, 0.05));
  Scene stacked = one_cube(0.2);
  stacked.cubes[0].position_m.z() += 0.035;
  const auto push = smooth_push(0.1, 1);
  const auto bent = [&](double t_s) {
    Pose pose = push(t_s);
    pose.position_m.y() = 0.01 * t_s;
    return pose;
  };
  const auto twisted = [&](double t_s) {
    const Pose pose = push(t_s);
    return upright_pose(pose.position_m, 0.2 * t_s);
  };
  const auto turning_in_place = [&](double t_s) {
    return upright_pose(push(0).position_m, 0.2 * t_s);
  };
  const auto low = [&](double t_s) {
    Pose pose = push(t_s);
    pose.position_m.z() = 0.019;
    return pose;
  };
  const auto from_inside = [&](double t_s) {
    Pose pose = push(t_s);
    pose.position_m.x() += 0.01;
    return pose;
  };
  const auto from_afar = [&](double t_s) {
    Pose pose = push(t_s);
    pose.position_m.x() -= 0.01;
    return pose;
  };
  for (const std::string& name : every_straight_one) {
    using testing::HasSubstr;
    EXPECT_THAT(refusal(name, one_cube(0.2), turning_in_place), HasSubstr("the effector turned"));
    EXPECT_THAT(refusal(name, one_cube(0.2), low), HasSubstr("reaches into the table"));
    EXPECT_THAT(refusal(name, Scene{}, low), HasSubstr("reaches into the table"));
    EXPECT_THAT(refusal(name, two, from_inside), HasSubstr("the clone starts inside cube 1"));
    EXPECT_EQ(refusal(name, one_cube(0.2), push), "");
    EXPECT_THAT(refusal(name, two, push), HasSubstr("a second cube is touched"));
    EXPECT_THAT(refusal(name, stacked, push), HasSubstr("cube 1 does not stand on the table"));
    EXPECT_THAT(refusal(name, one_cube(0.2), bent), HasSubstr("off its straight line"));
    EXPECT_THAT(refusal(name, one_cube(0.2), twisted), HasSubstr("turned"));
    EXPECT_THAT(refusal(name, turned(one_cube(0.2), 0.3), from_afar),
                HasSubstr("not pushed squarely"));
    EXPECT_THAT(refusal(name, one_cube(0.2), smooth_push(0.1, 1, 0, 0.025)),
                HasSubstr("beside its center"));
  }
}

TEST(StraightStroke, IgnoresCubesThatAreNotTouched) {
  Scene scene = one_cube(0.2);
  scene.cubes.push_back(cube_of(0.2, 0, 0.1));
  scene.cubes.push_back(cube_of(0.2, 0.3));
  scene.cubes[2].yaw_rad = 0.4;
  for (const std::string& name : every_straight_one)
    EXPECT_EQ(refusal(name, scene, smooth_push(0.1, 1)), "") << name;
}

TEST(StraightStroke, PassesThroughWhileTheCloneIsNotSolid) {
  for (const std::string& name : every_straight_one) {
    const auto simulator = make_simulator(name);
    const Stroke stroke{.speed_m_s = 0.1, .length_m = 0.1};
    simulator->reset(one_cube(0.2), stroke.at(0));
    simulator->set_clone_solid(false);
    for (int i = 1; i <= 60; ++i) simulator->step(stroke.at(i / 60.0), 1.0 / 60);
    EXPECT_EQ(simulator->state().cubes[0].pose.position_m.x(), 0) << name;
    EXPECT_TRUE(simulator->state().contacts.empty());
  }
}

TEST(Simulators, OfOneStraightPushAreNotForSessions) {
  EXPECT_FALSE(every_straight_one.empty());
  for (const SimulatorEntry& entry : simulators()) {
    if (!entry.warning.empty()) continue;
    EXPECT_EQ(entry.for_sessions, entry.fit_for.several_cubes) << entry.name;
  }
}

}  // namespace
}  // namespace heft
