// Whole worlds: boxes at rest, many boxes, determinism, and scenes that stress a simulator.
#include <gtest/gtest.h>

#include <thread>

#include "base/Pose.h"
#include "physics/Pushes.h"

namespace heft {
namespace {

const Pose away = upright_pose({0, 0, 0.3}, 0);

TEST(RestingCubes, StayWhereTheyAre) {
  Scene scene;
  for (int i = 0; i < 3; ++i) scene.cubes.push_back(cube_of(i == 0 ? 0.015 : 0.8, 0, 0.08 * i));
  for (const std::string& name : every_solver) {
    const WorldState state = run(*make_simulator(name), scene, held(away), 60);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_LE((state.cubes[i].pose.position_m - scene.cubes[i].position_m).norm(), 0.01e-3);
      EXPECT_LE(rotation_vector(state.cubes[i].pose.orientation).norm(), 1e-4);
    }
  }
}

// The effector presses the cube all the time, so that it never sleeps.
TEST(RestingCubes, StayWhileTheyArePressedLightly) {
  const Stroke stroke{.speed_m_s = 0.1, .length_m = 0.004};
  const WorldState state = run(*make_simulator("bullet"), one_cube(0.2), along(stroke), 60);
  ASSERT_EQ(state.contacts.size(), 1u);
  EXPECT_LE((state.cubes[0].pose.position_m - Eigen::Vector3d(0, 0, 0.0175)).norm(), 0.01e-3);
}

TEST(Boxes, AnyNumberOfThem) {
  for (int n : {0, 1, 10}) {
    Scene scene;
    for (int i = 0; i < n; ++i) scene.cubes.push_back(cube_of(0.05, 0.05 * i));
    // Reaches half of them; the lag grows with every row.
    const auto simulator = make_simulator("bullet");
    const WorldState state = run(*simulator, scene, along(Stroke{}), 2);
    ASSERT_EQ(state.cubes.size(), static_cast<std::size_t>(n));
    for (int i = 0; i < n; ++i) {
      const Eigen::Vector3d& at_m = state.cubes[static_cast<std::size_t>(i)].pose.position_m;
      EXPECT_NEAR(at_m.z(), 0.0175, 1e-5);
      if (i < 3) {
        EXPECT_GT(at_m.x(), 0.05 * i + 0.02);
      } else if (i > 6) {
        EXPECT_NEAR(at_m.x(), 0.05 * i, 1e-6);
      }
    }
  }
}

TEST(Boxes, AStackStandsAndFallsWhenItsLowestCubeIsTakenAway) {
  Scene scene;
  for (int i = 0; i < 3; ++i) {
    Cube cube = cube_of(0.1);
    cube.position_m.z() += 0.035 * i;
    scene.cubes.push_back(cube);
  }
  const auto simulator = make_simulator("bullet");
  const WorldState standing = run(*simulator, scene, held(away), 2);
  EXPECT_NEAR(standing.cubes[2].pose.position_m.z(), 0.0875, 0.02e-3);
  simulator->place_cube(0, upright_pose({0.2, 0, 0.0175}, 0));
  for (int i = 0; i < 240; ++i) simulator->step(away, 1.0 / 240);
  EXPECT_NEAR(simulator->state().cubes[2].pose.position_m.z(), 0.0525, 0.1e-3);
}

TEST(Boxes, ACubeFallsFreelyAndLandsOnTheTable) {
  Scene scene = one_cube(0.2);
  scene.cubes[0].position_m.z() = 0.1175;
  const auto simulator = make_simulator("bullet");
  WorldState state = run(*simulator, scene, held(away), 0.1, 1000);
  EXPECT_NEAR(state.cubes[0].pose.position_m.z(), 0.1175 - 9.81 * 0.01 / 2, 0.1e-3 * 9.81 / 2);
  state = run(*simulator, scene, held(away), 1);
  EXPECT_NEAR(state.cubes[0].pose.position_m.z(), 0.0175, 0.01e-3);
}

TEST(Boxes, TheCloneStandsOnTheTableToo) {
  const Pose below = upright_pose({0, 0, 0.010}, 0);
  const WorldState state = run(*make_simulator("bullet"), Scene{}, held(below), 1);
  EXPECT_NEAR(state.clone.pose.position_m.z(), 0.020, 0.01e-3);
}

// A stroke that rotates, lifts and hits three cubes at an angle.
Pose busy_path(double t_s) {
  const Eigen::Vector3d at_m(-0.08 + 0.06 * std::sin(5 * t_s), 0.05 * std::sin(2 * t_s),
                             0.022 + 0.004 * std::sin(7 * t_s));
  return {at_m, rotation_from_vector({0.1 * std::sin(3 * t_s), 0.05, 0.4 * std::sin(4 * t_s)})};
}

Scene busy_scene() {
  Scene scene;
  scene.cubes = {cube_of(0.015, 0, -0.06), cube_of(0.2), cube_of(0.8, 0.01, 0.06)};
  return scene;
}

std::vector<std::string> busy_hashes(DecouplingSimulator& simulator) {
  std::vector<std::string> hashes;
  run(simulator, busy_scene(), busy_path, 4, 240,
      [&](double, const Pose&, const WorldState& state) { hashes.push_back(state_hash(state)); });
  return hashes;
}

TEST(Determinism, AResetWorldGivesTheSameBitsAsAFreshOne) {
  for (const std::string& name : every_solver) {
    const auto expected = busy_hashes(*make_simulator(name));
    const auto used = make_simulator(name);
    run(*used, one_cube(0.4), along(Stroke{}), 0.7);
    EXPECT_EQ(busy_hashes(*used), expected) << name;
    EXPECT_NE(expected.front(), expected.back());
  }
}

TEST(Determinism, WorldsInOtherThreadsChangeNothing) {
  const auto expected = busy_hashes(*make_simulator("bullet"));
  std::vector<std::vector<std::string>> hashes(4);
  std::vector<std::jthread> threads;
  for (auto& own : hashes)
    threads.emplace_back([&own] { own = busy_hashes(*make_simulator("bullet")); });
  threads.clear();
  for (const auto& own : hashes) EXPECT_EQ(own, expected);
}

struct RoughScene {
  const char* name;
  Scene scene;
  Pose (*path)(double t_s);
};

std::vector<RoughScene> rough_scenes() {
  Scene heavy_and_light;
  heavy_and_light.cubes = {cube_of(0.001, 0.03), cube_of(100, 0.066)};
  Scene offset = one_cube(0.2);
  offset.clone_offset = {{-0.03, 0.02, 0.05}, rotation_from_vector({0.5, -1, 2})};
  Scene high = one_cube(0.2);
  high.cubes[0].position_m.z() = 0.3;
  return {
      {"push", one_cube(0.2), [](double t_s) { return Stroke{}.at(t_s); }},
      {"tap", one_cube(0.2),
       [](double t_s) {
         return upright_pose({-0.065 + 0.01 * std::sin(40 * t_s), 0, 0.021}, 0);
       }},
      {"press into a heavy cube", one_cube(0.8),
       [](double t_s) {
         return upright_pose({-0.065 + std::min(0.3, 0.5 * t_s), 0, 0.021}, 0);
       }},
      {"press from above", one_cube(0.2),
       [](double t_s) {
         return upright_pose({0, 0, 0.06 - 0.05 * std::min(t_s, 1.0)}, 0);
       }},
      {"swipe at 2 m/s", one_cube(0.015),
       [](double t_s) {
         return upright_pose({-0.2 + 2 * std::min(t_s, 0.3), 0, 0.021}, 0);
       }},
      {"1 g against 100 kg", heavy_and_light, [](double t_s) { return Stroke{}.at(t_s); }},
      {"free return in translation and rotation", offset,
       [](double) {
         return upright_pose({-0.2, 0, 0.15}, 0);
       }},
      {"spin among the cubes", busy_scene(),
       [](double t_s) {
         return upright_pose({-0.03, 0, 0.021}, 8 * t_s);
       }},
      {"a cube falls on the effector", high,
       [](double) {
         return upright_pose({0.01, 0, 0.05}, 0.2);
       }},
      {"teleporting hand", busy_scene(),
       [](double t_s) {
         return upright_pose({std::fmod(37 * t_s, 0.3) - 0.15, std::fmod(11 * t_s, 0.2) - 0.1,
                              std::fmod(5 * t_s, 0.08)},
                             std::fmod(13 * t_s, 6.0));
       }},
  };
}

class Rate : public testing::TestWithParam<double> {};

// Speeds are bounded by those of the hand and of free fall; nothing leaves the hand or the table.
TEST_P(Rate, IsStable) {
  for (const std::string& name : every_solver) {
    for (bool decoupled : {true, false}) {
      for (RoughScene& rough : rough_scenes()) {
        rough.scene.coupling.decoupled = decoupled;
        double fastest_m_s = 0, farthest_m = 0, lowest_m = 1, hand_m_s = 0;
        Eigen::Vector3d last_m = rough.path(0).position_m;
        run(*make_simulator(name), rough.scene, rough.path, 2, GetParam(),
            [&](double, const Pose& target, const WorldState& state) {
              hand_m_s = std::max(hand_m_s, (target.position_m - last_m).norm() * GetParam());
              last_m = target.position_m;
              ASSERT_TRUE(state.clone.pose.position_m.allFinite());
              farthest_m =
                  std::max(farthest_m, (state.clone.pose.position_m - target.position_m).norm());
              for (const BodyState& cube : state.cubes) {
                ASSERT_TRUE(cube.pose.position_m.allFinite());
                fastest_m_s = std::max(fastest_m_s, cube.velocity.linear_m_s.norm());
                lowest_m = std::min(lowest_m, cube.pose.position_m.z());
              }
            });
        const std::string which =
            name + (decoupled ? " C2 " : " C1 ") + rough.name + " at " + std::to_string(GetParam());
        // A coupled clone is as fast as the hand; the spring bounds the speed of a decoupled one.
        EXPECT_LT(fastest_m_s, decoupled ? 15 : std::max(3.0, 2 * hand_m_s)) << which;
        EXPECT_LT(farthest_m, 0.5) << which;
        if (decoupled) {
          EXPECT_GT(lowest_m, 0.012) << which;
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Hz, Rate, testing::Values(15, 30, 60, 120, 240, 500, 1000));

TEST(Simulators, AreFoundByNameAndTheNearestNameIsOffered) {
  EXPECT_EQ(simulators().front().name, "boxes");
  for (const SimulatorEntry& entry : simulators())
    if (entry.make != nullptr) {
      EXPECT_NE(make_simulator(entry.name), nullptr);
    }
  try {
    make_simulator("bulet-x");
    FAIL() << "no error";
  } catch (const std::exception& error) {
    EXPECT_NE(std::string(error.what()).find("did you mean \"bullet-x\"?"), std::string::npos)
        << error.what();
  }
}

TEST(Simulators, ThatFailAreListedButNotBuiltIn) {
  int n = 0;
  for (const SimulatorEntry& entry : simulators()) {
    EXPECT_EQ(entry.make == nullptr, !entry.warning.empty()) << entry.name;
    if (entry.make) continue;
    ++n;
    EXPECT_THROW(simulator_named(entry.name), OnlyForStudies) << entry.name;
  }
  EXPECT_EQ(n, 6);
}

TEST(Simulators, TheDefaultIsLx) {
  EXPECT_EQ(busy_hashes(*make_simulator("bullet")), busy_hashes(*make_simulator("bullet-lx")));
}

}  // namespace
}  // namespace heft
