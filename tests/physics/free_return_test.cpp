// The clone released at rest with an offset from a still effector, without contacts.
#include <gtest/gtest.h>

#include "base/Pose.h"
#include "physics/Pushes.h"
#include "physics/scene/Oracles.h"

namespace heft {
namespace {

const Pose in_the_air{{0, 0, 0.2}, Eigen::Quaterniond::Identity()};

struct Errors {
  double sum = 0;
  int n = 0;
  void add(double error) {
    sum += error * error;
    ++n;
  }
  double rms() const { return std::sqrt(sum / n); }
};

double translation_rms_m(const std::string& name, const Eigen::Vector3d& offset_m,
                         double rate_hz = 240) {
  Scene scene;
  scene.clone_offset.position_m = offset_m;
  const FreeReturn left(50, 0.010, 1);
  Errors errors;
  run(*make_simulator(name), scene, held(in_the_air), 0.5, rate_hz,
      [&](double t_s, const Pose& target, const WorldState& state) {
        errors.add((state.clone.pose.position_m - target.position_m - left(t_s) * offset_m).norm());
      });
  return errors.rms();
}

TEST(FreeReturn30mm, ExactSchemesWithin10Micrometers) {
  for (const char* name : {"bullet", "bullet-x", "bullet-lx"}) {
    EXPECT_LE(translation_rms_m(name, {0.030, 0, 0}), 0.01e-3) << name;
    EXPECT_LE(translation_rms_m(name, {0.010, -0.020, 0.020}), 0.01e-3) << name;
  }
}

TEST(FreeReturn30mm, ImplicitEulerWithinHalfAMillimeterAndFirstOrder) {
  const double coarse_m = translation_rms_m("bullet-ea", {0.030, 0, 0});
  EXPECT_LE(coarse_m, 0.5e-3);
  EXPECT_NEAR(translation_rms_m("bullet-ea", {0.030, 0, 0}, 960) / coarse_m, 0.25, 0.05);
}

// With a soft torsional spring, so that the rotation is visible.
TEST(FreeReturnInRotation, FollowsTheClosedFormAboutEachAxis) {
  for (int axis = 0; axis < 3; ++axis) {
    Scene scene;
    scene.coupling.torsional_stiffness_nm_per_rad = 0.02;
    const Eigen::Vector3d offset_rad = 0.5 * Eigen::Vector3d::Unit(axis);
    scene.clone_offset.orientation = rotation_from_vector(offset_rad);
    const double side_a_m = scene.effector_size_m[(axis + 1) % 3];
    const double side_b_m = scene.effector_size_m[(axis + 2) % 3];
    const double inertia_kg_m2 = 0.010 / 12 * (side_a_m * side_a_m + side_b_m * side_b_m);
    const FreeReturn left(0.02, inertia_kg_m2, 1);
    Errors exact, euler;
    for (auto [name, errors] : {std::pair{"bullet-x", &exact}, {"bullet-ea", &euler}}) {
      run(*make_simulator(name), scene, held(in_the_air), 0.5, 240,
          [&, &errors = errors](double t_s, const Pose&, const WorldState& state) {
            errors->add(
                (rotation_vector(state.clone.pose.orientation) - left(t_s) * offset_rad).norm());
          });
    }
    EXPECT_LE(exact.rms(), 1e-9);
    EXPECT_LE(euler.rms(), 0.02);
  }
}

TEST(LockedOrientation, IsTheEffectorsAfterOneStep) {
  Scene scene;
  scene.clone_offset.orientation = rotation_from_vector({0.3, -0.2, 0.5});
  const auto simulator = make_simulator("bullet-lx");
  simulator->reset(scene, in_the_air);
  simulator->step(in_the_air, 1.0 / 240);
  EXPECT_EQ(simulator->state().clone.pose.orientation.coeffs(), in_the_air.orientation.coeffs());
}

TEST(Clone, DoesNotSag) {
  for (const std::string& name : every_solver) {
    const WorldState state = run(*make_simulator(name), Scene{}, held(in_the_air), 2);
    EXPECT_NEAR(state.clone.pose.position_m.z(), 0.2, 1e-12) << name;
  }
}

TEST(Clone, StartsAtItsOffsetFromATurnedEffector) {
  Scene scene;
  scene.clone_offset.position_m = {0.01, 0, 0};
  const auto simulator = make_simulator("bullet");
  simulator->reset(scene, upright_pose({0, 0, 0.2}, M_PI / 2));
  EXPECT_TRUE(simulator->state().clone.pose.position_m.isApprox(Eigen::Vector3d(0, 0.01, 0.2)));
}

TEST(Clone, HasNoOffsetWhenItIsCoupled) {
  Scene scene;
  scene.coupling.decoupled = false;
  scene.clone_offset.position_m = {0.01, 0, 0};
  const auto simulator = make_simulator("bullet");
  simulator->reset(scene, in_the_air);
  EXPECT_EQ(simulator->state().clone.pose.position_m, in_the_air.position_m);
}

}  // namespace
}  // namespace heft
