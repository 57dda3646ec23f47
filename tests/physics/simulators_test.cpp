// Runs the closed forms on every simulator whose table entry declares that it models them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/Pose.h"
#include "physics/ContactScenes.h"
#include "physics/scene/Oracles.h"

namespace heft {
namespace {

constexpr double rate_hz = 240, relative = 0.02;

std::vector<std::string> simulators_fit_for(bool Fitness::*kind) {
  return simulators_where([&](const SimulatorEntry& entry) { return entry.fit_for.*kind; });
}

// Distance of the clone behind the effector along a stroke, at its end.
double lag_m(const std::string& simulator, const Scene& scene, const Stroke& stroke) {
  const double end_s = stroke.duration_s() - 0.001;
  const WorldState state = run(*make_simulator(simulator), scene, along(stroke), end_s, rate_hz);
  return (stroke.at(end_s).position_m - state.clone.pose.position_m).dot(stroke.direction());
}

TEST(EverySimulator, IsFitForWhatItsTableSaysOrHasAWarning) {
  for (const SimulatorEntry& entry : simulators())
    EXPECT_NE(entry.fit_for.straight, !entry.warning.empty()) << entry.name;
}

TEST(EverySimulator, OfStraightPushesLagsByTheForceOfFriction) {
  for (const std::string& name : simulators_fit_for(&Fitness::straight))
    for (const double mass_kg : {0.1, 0.2, 0.4}) {
      const double closed_m = steady_lag_m(0.8, mass_kg, 50);
      const double found_m =
          lag_m(name, one_cube(mass_kg), {.speed_m_s = 0.05, .length_m = 0.12 + closed_m});
      EXPECT_NEAR(found_m, closed_m, relative * closed_m) << name << ", " << mass_kg << " kg";
    }
}

TEST(EverySimulator, OfStraightPushesLagsByTheFrictionOfTheCube) {
  for (const std::string& name : simulators_fit_for(&Fitness::straight))
    for (const double friction : {0.2, 1.2}) {
      Scene scene = one_cube(0.2);
      scene.cubes[0].table_friction = friction;
      const double closed_m = steady_lag_m(friction, 0.2, 50);
      const double found_m = lag_m(name, scene, {.speed_m_s = 0.05, .length_m = 0.12 + closed_m});
      EXPECT_NEAR(found_m, closed_m, relative * closed_m) << name << ", friction " << friction;
      const double equal_m = lag_m(name, one_cube(0.2 * friction / 0.8),
                                   {.speed_m_s = 0.05, .length_m = 0.12 + closed_m});
      EXPECT_NEAR(found_m, equal_m, 0.01 * closed_m) << name << ", a mass of the same force";
    }
}

TEST(EverySimulator, OfSeveralCubesHasTheFrictionOfEach) {
  for (const std::string& name : simulators_fit_for(&Fitness::several_cubes)) {
    Scene scene = one_cube(0.1);
    scene.cubes.push_back(cube_of(0.2, 0.0355));
    // Friction between the cubes would shift weight from one to the other.
    scene.friction = 0;
    scene.cubes[0].table_friction = 0.8;
    scene.cubes[1].table_friction = 0.2;
    const double closed_m = steady_lag_m(0.8, 0.1, 50) + steady_lag_m(0.2, 0.2, 50);
    EXPECT_NEAR(lag_m(name, scene, {.speed_m_s = 0.05, .length_m = 0.12 + closed_m}), closed_m,
                relative * closed_m)
        << name;
  }
}

TEST(EverySimulator, OfACoupledCloneKeepsItOnTheEffectorWhateverTheMass) {
  for (const std::string& name : simulators_fit_for(&Fitness::coupled)) {
    std::vector<double> ends_m;
    for (const double mass_kg : {0.015, 1.5}) {
      Scene scene = one_cube(mass_kg);
      scene.coupling.decoupled = false;
      const Stroke stroke{.speed_m_s = 0.05, .length_m = 0.1};
      const WorldState state =
          run(*make_simulator(name), scene, along(stroke), stroke.duration_s(), rate_hz);
      EXPECT_EQ(state.clone.pose.position_m, stroke.at(stroke.duration_s()).position_m) << name;
      ends_m.push_back(state.cubes[0].pose.position_m.x());
    }
    EXPECT_NEAR(ends_m[0], 0.098, 1e-3) << name;
    EXPECT_NEAR(ends_m[0], ends_m[1], 1e-3) << name;
  }
}

TEST(EverySimulator, OfATorsionalSpringReturnsAsTheClosedForm) {
  for (const std::string& name : simulators_fit_for(&Fitness::turning)) {
    Scene scene;
    scene.coupling.torsional_stiffness_nm_per_rad = 2e-4;
    scene.clone_offset.orientation = rotation_from_vector(Eigen::Vector3d(0, 0, 0.2));
    const double inertia =
        box_inertia_kg_m2(scene.coupling.clone_mass_kg, scene.effector_size_m).z();
    const FreeReturn left(scene.coupling.torsional_stiffness_nm_per_rad, inertia, 1);
    const WorldState state =
        run(*make_simulator(name), scene, held(upright_pose({0, 0, 0.3}, 0)), 0.25, rate_hz);
    EXPECT_NEAR(rotation_vector(state.clone.pose.orientation).z(), 0.2 * left(0.25), 0.01) << name;
  }
}

TEST(EverySimulator, OfSeveralCubesLagsByTheirSum) {
  for (const std::string& name : simulators_fit_for(&Fitness::several_cubes)) {
    Scene scene = one_cube(0.1);
    scene.cubes.push_back(cube_of(0.2, 0.0355));
    const double closed_m = steady_lag_m(0.8, 0.3, 50);
    EXPECT_NEAR(lag_m(name, scene, {.speed_m_s = 0.05, .length_m = 0.12 + closed_m}), closed_m,
                relative * closed_m)
        << name;
  }
}

TEST(EverySimulator, OfCompliantContactsLetsACubeSinkByAQuarterOfItsWeight) {
  for (const std::string& name : simulators_fit_for(&Fitness::compliant)) {
    Scene scene = one_cube(0.4);
    scene.contact_compliance_m_per_n = 1e-4;
    const WorldState state =
        run(*make_simulator(name), scene, held(upright_pose({0, 0, 0.3}, 0)), 0.5, rate_hz);
    EXPECT_NEAR(state.cubes[0].pose.position_m.z(), 0.0175 - 1e-4 * 0.4 * 9.81 / 4, 1e-6) << name;
    const double closed_m = steady_lag_m(0.8, 0.4, 50);
    EXPECT_NEAR(lag_m(name, scene, {.speed_m_s = 0.05, .length_m = 0.12 + closed_m}), closed_m,
                relative * closed_m)
        << name;
  }
}

}  // namespace
}  // namespace heft
