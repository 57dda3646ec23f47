// `boxes` in scenes without a closed form: convergence, agreement with Bullet, stability,
// repeatability.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "base/Pose.h"
#include "physics/ContactScenes.h"

namespace heft {
namespace {

// The clone's path, 60 times a second.
std::vector<Eigen::Vector3d> clone_path_m(const std::string& name, const ContactScene& contact,
                                          double rate_hz) {
  std::vector<Eigen::Vector3d> path_m;
  const int every = static_cast<int>(std::lround(rate_hz / 60));
  int n = 0;
  run(*make_simulator(name), contact.scene, contact.path, contact.duration_s, rate_hz,
      [&](double, const Pose&, const WorldState& state) {
        if (++n % every == 0) path_m.push_back(state.clone.pose.position_m);
      });
  return path_m;
}

double rms_m(const std::vector<Eigen::Vector3d>& a, const std::vector<Eigen::Vector3d>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]).squaredNorm();
  return std::sqrt(sum / static_cast<double>(a.size()));
}

class WellPosed : public testing::TestWithParam<ContactScene> {};

TEST_P(WellPosed, IsNearItsLimitAndNoFartherThanBullet) {
  const auto limit_m = clone_path_m("boxes", GetParam(), 3840);
  const double at_240_m = rms_m(clone_path_m("boxes", GetParam(), 240), limit_m);
  const double at_120_m = rms_m(clone_path_m("boxes", GetParam(), 120), limit_m);
  EXPECT_LE(at_240_m, 0.1e-3);
  EXPECT_LE(at_120_m, 0.25e-3);
  const double bullet_m = rms_m(clone_path_m("bullet-lx", GetParam(), 240), limit_m);
  EXPECT_LE(at_240_m, bullet_m + 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Scenes, WellPosed, testing::ValuesIn(contact_scenes::well_posed()),
                         [](const auto& test) {
                           std::string name = test.param.name;
                           std::erase_if(name, [](char c) { return !std::isalnum(c); });
                           return name;
                         });

double energy_j(const Scene& scene, const Pose& target, const WorldState& state) {
  const Coupling& coupling = scene.coupling;
  const Eigen::Vector3d offset_m = state.clone.pose.position_m - target.position_m;
  double energy = coupling.stiffness_n_per_m * offset_m.squaredNorm() / 2 +
                  coupling.clone_mass_kg * state.clone.velocity.linear_m_s.squaredNorm() / 2;
  for (std::size_t i = 0; i < state.cubes.size(); ++i) {
    const Cube& cube = scene.cubes[i];
    const BodyState& body = state.cubes[i];
    const double inertia = cube.mass_kg * cube.size_m.x() * cube.size_m.x() / 6;
    energy += cube.mass_kg * (body.velocity.linear_m_s.squaredNorm() / 2 +
                              scene.gravity_m_s2 * body.pose.position_m.z()) +
              inertia * body.velocity.angular_rad_s.squaredNorm() / 2;
  }
  return energy;
}

Eigen::Vector3d any_vector(double size) {
  const auto unit = [] { return *rc::gen::inRange(-1000, 1001) / 1000.0; };
  const double x = unit(), y = unit(), z = unit();
  return size * Eigen::Vector3d(x, y, z);
}

Scene any_scene() {
  Scene scene;
  scene.coupling.stiffness_n_per_m = std::pow(10, *rc::gen::inRange(0, 6));
  scene.coupling.torsional_stiffness_nm_per_rad = std::pow(10, *rc::gen::inRange(-5, 5));
  scene.coupling.clone_mass_kg = *rc::gen::elementOf(std::vector<double>{1e-3, 0.01, 0.1});
  scene.coupling.damping_ratio = *rc::gen::elementOf(std::vector<double>{0.5, 1.0, 2.0});
  const int n = *rc::gen::inRange(1, 4);
  for (int i = 0; i < n; ++i) {
    const double mass_kg = *rc::gen::elementOf(std::vector<double>{0.001, 0.015, 0.2, 1.5, 100});
    scene.cubes.push_back(cube_of(mass_kg, 0.036 * i, 0.01 * *rc::gen::inRange(-2, 3)));
  }
  return scene;
}

const std::vector<double> every_rate{15, 30, 60, 240, 960, 2000};

// The clone is released in free space, and its spring throws it at cubes.
RC_GTEST_PROP(BoxesProperty, EnergyNeverGrowsWhileTheTargetRests, ()) {
  Scene scene = any_scene();
  scene.clone_offset.position_m = {-0.04 - 0.001 * *rc::gen::inRange(0, 50), 0, 0};
  const Pose target = upright_pose({-0.055, 0, 0.0205}, 0);
  const double rate_hz = *rc::gen::elementOf(every_rate);
  const auto simulator = make_simulator("boxes");
  simulator->reset(scene, target);
  double last_j = energy_j(scene, target, simulator->state()), first_j = last_j;
  for (int i = 0; i < 300; ++i) {
    simulator->step(target, 1 / rate_hz);
    const double now_j = energy_j(scene, target, simulator->state());
    RC_ASSERT(std::isfinite(now_j));
    RC_ASSERT(now_j <= first_j * (1 + 1e-6));
    last_j = now_j;
  }
}

Pose any_path(const Eigen::Vector3d& shake_m, const Eigen::Vector3d& turn_rad, double t_s) {
  const Eigen::Vector3d at_m(-0.06 + shake_m.x() * std::sin(5 * t_s),
                             shake_m.y() * std::sin(3 * t_s),
                             0.03 + shake_m.z() * std::sin(7 * t_s));
  return {at_m, rotation_from_vector(turn_rad * std::sin(4 * t_s))};
}

RC_GTEST_PROP(BoxesProperty, IsStableAndRepeatsItselfAfterAReset, ()) {
  Scene scene = any_scene();
  scene.coupling.decoupled = *rc::gen::arbitrary<bool>();
  const Eigen::Vector3d shake_m = any_vector(0.08), turn_rad = any_vector(0.6);
  const double rate_hz = *rc::gen::elementOf(every_rate);
  const auto path = [&](double t_s) { return any_path(shake_m, turn_rad, t_s); };
  const auto simulator = make_simulator("boxes");
  std::vector<std::string> hashes;
  for (int time = 0; time < 2; ++time) {
    std::size_t i = 0;
    run(*simulator, scene, path, 100 / rate_hz, rate_hz,
        [&](double, const Pose&, const WorldState& state) {
          RC_ASSERT(state.clone.pose.position_m.norm() < 10);
          for (const BodyState& cube : state.cubes) {
            RC_ASSERT(cube.pose.position_m.norm() < 20);
            RC_ASSERT(std::abs(cube.pose.orientation.norm() - 1) < 1e-9);
          }
          if (time == 0) hashes.push_back(state_hash(state));
          if (time == 1) RC_ASSERT(state_hash(state) == hashes[i++]);
        });
  }
}

// There is no solution for a hand that presses cubes into the table and each other; a diverging
// solver must not throw them.
TEST(BoxesProperty, WhatIsSqueezedIsNotFlung) {
  struct Squeeze {
    Coupling coupling;
    double second_kg, rate_hz;
    Eigen::Vector3d shake_m, turn_rad;
  };
  const Coupling stiff{.stiffness_n_per_m = 1e5,
                       .torsional_stiffness_nm_per_rad = 1e-3,
                       .clone_mass_kg = 1e-3,
                       .damping_ratio = 0.5};
  Coupling held;
  held.decoupled = false;
  for (const auto& [coupling, second_kg, rate_hz, shake_m, turn_rad] : std::vector<Squeeze>{
           {stiff, 0.015, 15, {-0.04072, -0.07288, 0.01744}, {0.2154, -0.2418, -0.2622}},
           {held, 100, 30, {0.03608, 0.0136, 0.00768}, {0.3066, -0.072, -0.309}}}) {
    Scene scene;
    scene.coupling = coupling;
    const double first_kg = coupling.decoupled ? 0.001 : 1.5;
    scene.cubes = {cube_of(first_kg, 0, coupling.decoupled ? 0 : 0.01),
                   cube_of(second_kg, 0.036, 0.01)};
    const auto path = [&, &shake_m = shake_m, &turn_rad = turn_rad](double t_s) {
      return any_path(shake_m, turn_rad, t_s);
    };
    run(*make_simulator("boxes"), scene, path, 100 / rate_hz, rate_hz,
        [&, &second_kg = second_kg](double t_s, const Pose&, const WorldState& state) {
          for (const BodyState& cube : state.cubes)
            EXPECT_LT(cube.velocity.linear_m_s.norm(), 3) << second_kg << " kg at " << t_s << " s";
        });
  }
}

// Sweeps converge slowly for a light cube between clone and heavy cube; ending them early rotates
// the row.
TEST(Boxes, ALightCubeBeforeAHeavyOneSettlesAtEveryRate) {
  ContactScene contact;
  contact.scene.cubes = {cube_of(0.001, 0), cube_of(1, 0.055)};
  contact.path = along(Stroke{.speed_m_s = 0.1, .length_m = 0.2});
  contact.duration_s = 2;
  const auto limit_m = clone_path_m("boxes", contact, 960);
  for (double rate_hz : {60.0, 120.0, 240.0})
    EXPECT_LE(rms_m(clone_path_m("boxes", contact, rate_hz), limit_m), 0.01e-3) << rate_hz << " Hz";
}

TEST(BoxesProperty, TheMirrorImageOfASceneHasTheMirrorImageOfItsPath) {
  for (double side_m : {0.0, 0.004, 0.006}) {
    std::vector<WorldState> both;
    for (double sign : {1.0, -1.0}) {
      Scene scene = one_cube(0.2);
      both.push_back(run(*make_simulator("boxes"), scene,
                         contact_scenes::smooth_push(0.1, 1, 0, sign * side_m), 1.2, 480));
    }
    const auto mirrored = [](Eigen::Vector3d v) {
      v.y() = -v.y();
      return v;
    };
    EXPECT_LT((both[0].clone.pose.position_m - mirrored(both[1].clone.pose.position_m)).norm(),
              0.02e-3);
  }
}

}  // namespace
}  // namespace heft
