// The energy balance where each of its terms has a closed form.
#include <gtest/gtest.h>

#include "base/PoseTypes.h"
#include "physics/scene/Oracles.h"
#include "results/physics/scenes/Measurements.h"

namespace heft {
namespace {

BenchScene along_x(const Pose& from, double way_m, double duration_s) {
  BenchScene scene;
  Pose to = from;
  to.position_m.x() += way_m;
  scene.path = {{0, from}, {duration_s, to}};
  return scene;
}

SceneTrack track_of(const BenchScene& scene, int rate_hz) {
  return run_scene(make_simulator("boxes"), scene, rate_hz, rate_hz).track;
}

// A clone released at x0 loses the spring's energy k x0^2 / 2 to the damper, and the hand does no
// work.
TEST(EnergyBalance, AReleasedCloneLosesWhatItsSpringHeld) {
  BenchScene scene = along_x(upright_pose({-0.2, 0, 0.1}, 0), 0, 0.5);
  scene.scene.clone_offset.position_m = {0.02, 0, 0};
  for (int rate_hz : {240, 960}) {
    const auto balance = energy_balance(track_of(scene, rate_hz), scene);
    ASSERT_TRUE(balance);
    EXPECT_NEAR(balance->stored_j, -50 * 0.02 * 0.02 / 2, 1e-9);
    EXPECT_NEAR(balance->damped_j, 50 * 0.02 * 0.02 / 2, 5e-6);
    EXPECT_EQ(balance->hand_work_j, 0);
    EXPECT_NEAR(balance->left_j(), 0, 5e-6);
  }
}

// Without friction, a coupled clone hits a cube of mass M, which then has its speed u: the hand
// does the work M u^2, half of which the cube has and half of which the impact dissipates.
TEST(EnergyBalance, AHitTakesHalfOfWhatTheHandGives) {
  constexpr double mass_kg = 0.2, u_m_s = 0.2, moving_j = mass_kg * u_m_s * u_m_s / 2;
  BenchScene scene = along_x(upright_pose({-0.0825, 0, 0.0215}, 0), 0.06, 0.06 / u_m_s);
  scene.scene.coupling.decoupled = false;
  scene.scene.friction = 0;
  scene.scene.cubes = {Cube{}};
  const auto balance = energy_balance(track_of(scene, 240), scene);
  ASSERT_TRUE(balance);
  EXPECT_NEAR(balance->hand_work_j, 2 * moving_j, 1e-3 * moving_j);
  EXPECT_NEAR(balance->stored_j, moving_j, 1e-3 * moving_j);
  EXPECT_NEAR(balance->left_j(), moving_j, 1e-3 * moving_j);
  EXPECT_EQ(balance->damped_j, 0);
  EXPECT_EQ(balance->rubbed_j, 0);
}

// In steady sliding, friction dissipates all work of the hand.
TEST(EnergyBalance, ASteadyPushIsAllFriction) {
  constexpr int rate_hz = 240, steady_from_s = 3;
  BenchScene scene = along_x(upright_pose({-0.0825, 0, 0.0215}, 0), 0.4, 4);
  scene.scene.cubes = {Cube{}};
  const SceneTrack whole = track_of(scene, rate_hz);
  scene.path = {{0, *Trajectory(scene.path).at(steady_from_s)}, {1, scene.path[1].pose}};
  const SceneTrack steady{rate_hz,
                          {whole.states.begin() + steady_from_s * rate_hz, whole.states.end()}};
  const auto balance = energy_balance(steady, scene);
  ASSERT_TRUE(balance);
  const double rubbed_j = sliding_force_n(0.8, 0.2) * 0.1;
  EXPECT_NEAR(balance->hand_work_j, rubbed_j, 1e-3 * rubbed_j);
  EXPECT_NEAR(balance->rubbed_j, rubbed_j, 1e-3 * rubbed_j);
  EXPECT_NEAR(balance->left_j(), 0, 1e-3 * rubbed_j);
}

TEST(EnergyBalance, IsNotStatedForStacks) {
  BenchScene scene = along_x(upright_pose({-0.2, 0, 0.1}, 0), 0, 0.1);
  scene.scene.cubes = {Cube{}, Cube{}};
  scene.scene.cubes[1].position_m.z() += 0.035;
  EXPECT_FALSE(energy_balance(track_of(scene, 60), scene));
}

}  // namespace
}  // namespace heft
