// `boxes` against closed forms, and properties of its contacts.
#include <gtest/gtest.h>

#include "base/Pose.h"
#include "physics/ContactScenes.h"
#include "physics/scene/BoxContacts.h"
#include "physics/scene/Oracles.h"

namespace heft {
namespace {

constexpr double degree = std::numbers::pi / 180;

// Deepest overlap of any two boxes, or of one with the table, m.
double deepest_m(const Scene& scene, const WorldState& state) {
  std::vector<Box> boxes{box_at(state.clone.pose, scene.effector_size_m)};
  for (std::size_t i = 0; i < state.cubes.size(); ++i)
    boxes.push_back(box_at(state.cubes[i].pose, scene.cubes[i].size_m));
  double deepest_m = 0;
  const auto look = [&](const Contact& contact) {
    for (const ContactPoint& point : contact.all())
      deepest_m = std::max(deepest_m, -point.distance_m);
  };
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    look(contact_with_table(boxes[i], 0));
    for (std::size_t j = 0; j < i; ++j) look(contact_between(boxes[i], boxes[j], 0));
  }
  return deepest_m;
}

// At any number of steps.
TEST(Boxes, AStiffCloneStaysOutsideTheCubeThatItPushes) {
  for (const double stiffness_n_per_m : {500.0, 1500.0, 5000.0, 5e4, 5e5, 1e7})
    for (const double rate_hz : {15.0, 30.0, 60.0, 120.0, 240.0}) {
      Scene scene = one_cube(0.1);
      scene.coupling.stiffness_n_per_m = stiffness_n_per_m;
      const Stroke stroke{.speed_m_s = 0.1, .length_m = 0.1};
      double overlap_m = 0;
      run(*make_simulator("boxes"), scene, along(stroke), 1.2, rate_hz,
          [&](double, const Pose&, const WorldState& state) {
            overlap_m = std::max(overlap_m, deepest_m(scene, state));
          });
      EXPECT_LT(overlap_m, 0.005e-3) << stiffness_n_per_m << " N/m at " << rate_hz << " Hz";
    }
}

class BoxesLag : public testing::TestWithParam<double> {};

// Long after the start; a tenth of a percent is 2 um for the lightest cube.
TEST_P(BoxesLag, IsWithinATenthOfAPercentInEveryDirection) {
  for (double degrees : {0.0, 17.0, 30.0, 45.0, 90.0, 200.0}) {
    for (double speed_m_s : {0.03, 0.1, 0.25}) {
      const double mass_kg = GetParam(), lag_m = steady_lag_m(0.8, mass_kg, 50);
      const double damping_n_s_m = 2 * std::sqrt(50 * 0.010);
      const double settled_s = 10 * 2 * (0.010 + mass_kg) / damping_n_s_m;  // e^-10 is left
      const double duration_s = std::ceil(2 * lag_m / speed_m_s + settled_s);
      Stroke stroke{.speed_m_s = speed_m_s, .length_m = 100};
      stroke.heading_rad = degrees * degree;
      Scene scene = one_cube(mass_kg);
      scene.cubes[0].yaw_rad = stroke.heading_rad;
      const WorldState state = run(*make_simulator("boxes"), scene, along(stroke), duration_s);
      const Pose target = stroke.at(duration_s);
      const double found_m =
          (target.position_m - state.clone.pose.position_m).dot(stroke.direction());
      EXPECT_NEAR(found_m / lag_m, 1, 1e-3) << degrees << " degrees " << speed_m_s << " m/s";
      ASSERT_EQ(state.contacts.size(), 1u);
      EXPECT_NEAR(state.contacts[0].force_n.norm() / sliding_force_n(0.8, mass_kg), 1, 1e-3);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Masses, BoxesLag, testing::Values(0.015, 0.05, 0.2, 0.5));

// Friction on a disk is isotropic, so the deceleration does not depend on the cube's yaw.
TEST(Boxes, ASlidingCubeIsSlowedAlikeWhateverItsYaw) {
  for (double degrees : {0.0, 10.0, 30.0, 45.0}) {
    Scene scene = one_cube(0.2);
    scene.coupling.decoupled = false;
    scene.cubes[0].yaw_rad = degrees * degree;
    Stroke stroke{.speed_m_s = 0.5, .length_m = 0.1};
    stroke.heading_rad = degrees * degree;
    const WorldState state = run(*make_simulator("boxes"), scene, along(stroke), 0.6, 960);
    const double slide_m = 0.5 * 0.5 / (2 * 0.8 * 9.81);
    EXPECT_NEAR(state.cubes[0].pose.position_m.dot(stroke.direction()), 0.098 + slide_m, 0.3e-3);
    EXPECT_EQ(state.cubes[0].velocity.linear_m_s.norm(), 0);
  }
}

TEST(Boxes, FreeReturnIsExactInTranslationAndRotationForAnyDamping) {
  const Pose in_the_air{{0, 0, 0.2}, Eigen::Quaterniond::Identity()};
  for (double rate_hz : {30.0, 240.0, 2000.0}) {
    for (double damping : {0.3, 1.0, 1.7}) {
      for (double kappa : {0.02, 150.0}) {
        Scene scene;
        scene.coupling.damping_ratio = damping;
        scene.coupling.torsional_stiffness_nm_per_rad = kappa;
        scene.clone_offset = {{0.01, -0.02, 0.02}, rotation_from_vector({0, 0.5, 0})};
        const double inertia = 0.010 / 12 * (0.09 * 0.09 + 0.04 * 0.04);
        const FreeReturn straight(50, 0.010, damping), turning(kappa, inertia, damping);
        run(*make_simulator("boxes"), scene, held(in_the_air), 0.3, rate_hz,
            [&](double t_s, const Pose& target, const WorldState& state) {
              const Eigen::Vector3d offset_m = state.clone.pose.position_m - target.position_m;
              EXPECT_LT((offset_m - straight(t_s) * scene.clone_offset.position_m).norm(), 1e-9);
              EXPECT_NEAR(rotation_vector(state.clone.pose.orientation).y(), 0.5 * turning(t_s),
                          1e-8);
            });
      }
    }
  }
}

TEST(Boxes, ACubeFallsFreelyAndStaysDown) {
  Scene scene = one_cube(0.2);
  scene.cubes[0].position_m.z() = 0.1175;
  const Pose away = upright_pose({0, 0.3, 0.3}, 0);
  const WorldState falling = run(*make_simulator("boxes"), scene, held(away), 0.1, 60);
  EXPECT_NEAR(falling.cubes[0].pose.position_m.z(), 0.1175 - 9.81 * 0.01 / 2, 1e-9);
  const WorldState down = run(*make_simulator("boxes"), scene, held(away), 1, 60);
  EXPECT_NEAR(down.cubes[0].pose.position_m.z(), 0.0175, 1e-6);
  EXPECT_EQ(down.cubes[0].velocity.linear_m_s.norm(), 0);
}

TEST(Boxes, NothingCreepsWhilePressedForTenSeconds) {
  for (double grams : {200.0, 800.0, 1500.0}) {
    const Stroke stroke{.speed_m_s = 0.1, .length_m = 0.025};
    const Scene scene = one_cube(grams / 1000);
    const auto simulator = make_simulator("boxes");
    run(*simulator, scene, along(stroke), 1);
    const Eigen::Vector3d before_m = simulator->state().cubes[0].pose.position_m;
    for (int i = 0; i < 2400; ++i) simulator->step(stroke.at(1), 1.0 / 240);
    ASSERT_EQ(simulator->state().contacts.size(), 1u);
    EXPECT_LT((simulator->state().cubes[0].pose.position_m - before_m).norm(), 1e-6) << grams;
  }
}

// In C1 nothing depends on a cube's mass, unless cubes touch each other.
TEST(Boxes, ACoupledCloneIsBlindToMass) {
  for (double side_m : {0.0, 0.006, 0.028}) {
    for (double yaw_rad : {0.0, 0.5}) {
      std::vector<std::vector<Eigen::Vector3d>> paths;
      for (double mass_kg : {0.015, 0.2, 0.8, 1.5}) {
        Scene scene = contact_scenes::turned(one_cube(mass_kg), yaw_rad);
        scene.coupling.decoupled = false;
        auto& path = paths.emplace_back();
        run(*make_simulator("boxes"), scene, contact_scenes::smooth_push(0.12, 1, 0, side_m), 1.3,
            240, [&](double, const Pose& target, const WorldState& state) {
              EXPECT_EQ(state.clone.pose.position_m, target.position_m);
              path.push_back(state.cubes[0].pose.position_m);
            });
      }
      double widest_m = 0;
      for (const auto& path : paths)
        for (std::size_t i = 0; i < path.size(); ++i)
          widest_m = std::max(widest_m, (path[i] - paths[0][i]).norm());
      EXPECT_LE(widest_m, 1e-9) << side_m << ' ' << yaw_rad;
      EXPECT_GT((paths[0].back() - paths[0].front()).norm(), 0.02);
    }
  }
}

// A coupled hand that brakes throws its cube ahead; friction alone decelerates it until the hand
// meets it again.
TEST(Boxes, ACubeThatABrakingCoupledHandThrowsAheadIsMetWhereFrictionLetsIt) {
  const double fast_m_s = 0.3, brakes_s = 0.3, brakes_by_m_s2 = 0.8 * 9.81;
  Scene scene = one_cube(0.2);
  scene.coupling.decoupled = false;
  for (double slower_m_s : {0.02, 0.03, 0.06, 0.2}) {
    for (double rate_hz : {60.0, 240.0}) {
      const auto hand_m = [&](double t_s) {
        return fast_m_s * t_s - slower_m_s * std::max(0.0, t_s - brakes_s);
      };
      const auto path = [&](double t_s) {
        return upright_pose({-0.0645 + hand_m(t_s), 0, 0.021}, 0);
      };
      double worst_m = 0;
      run(*make_simulator("boxes"), scene, path, 0.5, rate_hz,
          [&](double t_s, const Pose&, const WorldState& state) {
            const double after_s = std::max(0.0, t_s - brakes_s);
            const double pushed_m = hand_m(t_s) - 0.002;
            const double flies_s = std::min(after_s, fast_m_s / brakes_by_m_s2);
            const double flies_m = hand_m(brakes_s) - 0.002 + fast_m_s * flies_s -
                                   brakes_by_m_s2 / 2 * flies_s * flies_s;
            const double at_m = std::max({0.0, pushed_m, after_s > 0 ? flies_m : 0.0});
            worst_m = std::max(worst_m, std::abs(state.cubes[0].pose.position_m.x() - at_m));
          });
      EXPECT_LT(worst_m, 4e-6) << slower_m_s << " m/s slower, " << rate_hz << " Hz";
    }
  }
}

// After a slow contact a rebound is limited to the velocity that friction removes within a step.
TEST(Boxes, ACubeThatACoupledCloneMeetsIsAsFastAsTheClone) {
  Scene scene = one_cube(0.2);
  scene.coupling.decoupled = false;
  for (double speed_m_s : {0.003, 0.008, 0.02}) {
    for (double rate_hz : {240.0, 3840.0, 15360.0}) {
      const auto path = [&](double t_s) {
        return upright_pose({-0.0626 + speed_m_s * t_s, 0, 0.021}, 0);
      };
      double fastest_m_s = 0;
      run(*make_simulator("boxes"), scene, path, 1e-4 / speed_m_s + 0.05, rate_hz,
          [&](double, const Pose&, const WorldState& state) {
            fastest_m_s = std::max(fastest_m_s, state.cubes[0].velocity.linear_m_s.x());
          });
      EXPECT_GE(fastest_m_s, (1 - 1e-6) * speed_m_s);
      EXPECT_LE(fastest_m_s, speed_m_s + 0.8 * 9.81 / rate_hz)
          << speed_m_s << " m/s, " << rate_hz << " Hz";
    }
  }
}

struct Swipe {
  double speed_m_s, heading_rad, side_m, yaw_rad;
};

class BoxesOverlap : public testing::TestWithParam<double> {};

TEST_P(BoxesOverlap, IsBelow50MicrometersUpTo2MetersPerSecond) {
  const double rate_hz = GetParam();
  for (bool decoupled : {true, false}) {
    for (const Swipe& swipe : {Swipe{2, 0, 0, 0}, Swipe{2, 0.4, 0.01, 0.1}, Swipe{1, 1, -0.02, 0.6},
                               Swipe{0.5, 2, 0.03, 0.3}, Swipe{2, 3, 0.0365, 0.8}}) {
      Scene scene = one_cube(0.05);
      scene.coupling.decoupled = decoupled;
      scene.cubes[0].yaw_rad = swipe.yaw_rad;
      Stroke stroke{.speed_m_s = swipe.speed_m_s,
                    .length_m = 0.3,
                    .heading_rad = swipe.heading_rad,
                    .side_m = swipe.side_m};
      const auto path = [&](double t_s) {
        Pose pose = stroke.at(t_s);
        pose.position_m -= 0.1 * stroke.direction();
        return pose;
      };
      double overlap_m = 0;
      bool hit = false;
      run(*make_simulator("boxes"), scene, path, 0.4 / swipe.speed_m_s, rate_hz,
          [&](double, const Pose&, const WorldState& state) {
            overlap_m = std::max(overlap_m, deepest_m(scene, state));
            hit = hit || state.cubes[0].pose.position_m.head<2>().norm() > 0.01;
          });
      EXPECT_TRUE(hit);
      EXPECT_LE(overlap_m, 0.05e-3) << rate_hz << " Hz " << swipe.speed_m_s << " m/s "
                                    << swipe.heading_rad << (decoupled ? " C2" : " C1");
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Hz, BoxesOverlap, testing::Values(15, 30, 60, 240, 1000));

TEST(Boxes, ACoupledCloneThatSqueezesACubeLeavesItOnTheTableAndLetsGo) {
  Scene scene = one_cube(0.2);
  scene.coupling.decoupled = false;
  const auto path = [](double t_s) {
    return upright_pose({0.005, 0, 0.06 - 0.01 * std::sin(std::min(t_s, 1.0) * std::numbers::pi)},
                        0);
  };
  const WorldState state = run(*make_simulator("boxes"), scene, path, 1.5, 240,
                               [](double, const Pose&, const WorldState& now) {
                                 EXPECT_GT(now.cubes[0].pose.position_m.z(), 0.0170);
                                 EXPECT_LT(now.cubes[0].velocity.linear_m_s.norm(), 0.5);
                               });
  EXPECT_NEAR(state.cubes[0].pose.position_m.z(), 0.0175, 0.02e-3);
  EXPECT_TRUE(state.contacts.empty());
}

TEST(Boxes, ACompliantPointSinksByItsShareOfTheLoad) {
  Scene scene = one_cube(0.2);
  scene.contact_compliance_m_per_n = 1e-4;
  const WorldState state =
      run(*make_simulator("boxes"), scene, held(upright_pose({0, 0, 0.3}, 0)), 1);
  EXPECT_NEAR(state.cubes[0].pose.position_m.z(), 0.0175 - 1e-4 * 0.2 * 9.81 / 4, 1e-6);
}

// The hand's speed determines the pieces of a step while the cube is near; the cube's stop must not
// depend on them.
// A hand that turns by 30 degrees while it pushes: 240 steps a second are as good as 3840.
TEST(Boxes, ACompliantCubeTurnsAlikeAtEveryRate) {
  for (const double mass_kg : {0.1, 0.4}) {
    Scene scene = one_cube(mass_kg);
    scene.contact_compliance_m_per_n = 1e-4;
    const auto turning = [](double t_s) {
      const double done = contact_scenes::smooth(t_s / 1.2);
      return upright_pose({-0.0645 + 0.09 * done, 0.004, 0.021}, 0.5 * done);
    };
    const auto path_m = [&](double rate_hz) {
      std::vector<Eigen::Vector3d> clone_m;
      run(*make_simulator("boxes"), scene, turning, 1.5, rate_hz,
          [&](double t_s, const Pose&, const WorldState& state) {
            const double ticks = t_s * 240;
            if (std::abs(ticks - std::round(ticks)) < 1e-6)
              clone_m.push_back(state.clone.pose.position_m);
          });
      return clone_m;
    };
    const auto coarse_m = path_m(240), fine_m = path_m(3840);
    ASSERT_EQ(coarse_m.size(), fine_m.size());
    double squares_m2 = 0;
    for (std::size_t i = 0; i < fine_m.size(); ++i)
      squares_m2 += (coarse_m[i] - fine_m[i]).squaredNorm();
    EXPECT_LT(std::sqrt(squares_m2 / static_cast<double>(fine_m.size())), 0.03e-3) << mass_kg;
  }
}

TEST(Boxes, AFastSwipeThrowsACubeEquallyFarAtEveryRate) {
  const auto stop_m = [](double rate_hz) {
    const auto path = [](double t_s) {
      return upright_pose({-0.3 + 2 * std::min(t_s, 0.25), 0, 0.021}, 0);
    };
    return run(*make_simulator("boxes"), one_cube(0.05), path, 0.8, rate_hz)
        .cubes[0]
        .pose.position_m.x();
  };
  const double far_m = stop_m(3840);
  EXPECT_GT(far_m, 0.3);
  for (double rate_hz : {60.0, 120.0, 240.0}) EXPECT_NEAR(stop_m(rate_hz), far_m, 0.5e-3);
}

// Friction between the clone and a tall, narrow box that tips over instead of sliding.
TEST(Boxes, ATallBoxTipsWhenPushedAboveItsBaseOverFriction) {
  for (double height_m : {0.03, 0.08}) {
    Scene scene = one_cube(0.1);
    scene.cubes[0].size_m = {0.035, 0.035, 0.12};
    scene.cubes[0].position_m.z() = 0.06;
    Stroke stroke{.speed_m_s = 0.05, .length_m = 0.06, .height_m = height_m};
    const WorldState state =
        run(*make_simulator("boxes"), scene, along(stroke), stroke.duration_s());
    const double tilt_rad = rotation_vector(state.cubes[0].pose.orientation).norm();
    // The lowest point of the tip is 20 mm below: it tips above 0.0175 / 0.8 = 21.9 mm.
    if (height_m - 0.02 > 0.0175 / 0.8) {
      EXPECT_GT(tilt_rad, 0.1);
    } else {
      EXPECT_LT(tilt_rad, 1e-3);
    }
  }
}

}  // namespace
}  // namespace heft
