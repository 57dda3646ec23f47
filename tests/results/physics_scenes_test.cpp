// The scenes of the physics study equal the files of tests/scenes/, and their references are
// accurate. HEFT_WRITE_SCENES=1 in the environment rewrites the files.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <set>

#include "SourceFolder.h"
#include "base/files/TextFile.h"
#include "physics/scene/Oracles.h"
#include "physics/scene/Scene.h"
#include "protocol/readers/Files.h"
#include "results/physics/scenes/Reference.h"

namespace heft {
namespace {

const std::string folder = source_folder() + "/tests/scenes/";

void expect_file(const std::string& name, const std::string& text) {
  if (std::getenv("HEFT_WRITE_SCENES")) std::ofstream(folder + name) << text;
  EXPECT_EQ(read_text_file(folder + name), text)
      << name << " differs from results/physics/scenes/Scenes.cpp; HEFT_WRITE_SCENES=1 rewrites it";
}

TEST(BenchScenes, AreTheShippedFiles) {
  for (const BenchScene& scene : bench_scenes()) {
    const std::string subfolder = scene.name.starts_with("push_") ? "pushes/" : "";
    expect_file(subfolder + scene.name + ".toml", scene_toml(scene));
    expect_file("paths/" + scene.path_name + ".csv", path_csv(scene));
  }
}

TEST(BenchScenes, ReadBackAsTheSameScenes) {
  std::set<std::string> names;
  for (const BenchScene& scene : bench_scenes()) {
    EXPECT_TRUE(names.insert(scene.name).second) << scene.name;
    const Scene read = parse_scene(scene_toml(scene), scene.name);
    EXPECT_EQ(read.coupling.decoupled, scene.scene.coupling.decoupled) << scene.name;
    EXPECT_EQ(read.coupling.stiffness_n_per_m, scene.scene.coupling.stiffness_n_per_m);
    EXPECT_EQ(read.coupling.torsional_stiffness_nm_per_rad,
              scene.scene.coupling.torsional_stiffness_nm_per_rad);
    EXPECT_EQ(read.contact_compliance_m_per_n, scene.scene.contact_compliance_m_per_n);
    EXPECT_EQ(read.clone_offset.position_m, scene.scene.clone_offset.position_m);
    ASSERT_EQ(read.cubes.size(), scene.scene.cubes.size());
    for (std::size_t i = 0; i < read.cubes.size(); ++i) {
      EXPECT_EQ(read.cubes[i].mass_kg, scene.scene.cubes[i].mass_kg);
      EXPECT_EQ(read.cubes[i].position_m, scene.scene.cubes[i].position_m);
      EXPECT_EQ(read.cubes[i].yaw_rad, scene.scene.cubes[i].yaw_rad);
    }
    const Trajectory path = parse_trajectory(path_csv(scene), scene.path_name);
    ASSERT_EQ(path.rows().size(), scene.path.size());
    EXPECT_EQ(path.end_s(), scene.path.back().t_s);
  }
}

TEST(BenchScenes, ThoseThatShareAPathShareAllOfIt) {
  for (const BenchScene& a : bench_scenes())
    for (const BenchScene& b : bench_scenes())
      if (a.path_name == b.path_name) {
        EXPECT_EQ(path_csv(a), path_csv(b)) << a.name << ' ' << b.name;
      }
}

TEST(Reference, OfAStraightPushEndsAtTheClosedForm) {
  const BenchScene scene = bench_scene("push_200g");
  const Reference reference = reference_of(scene, true);
  const auto at_end_of_stroke = static_cast<std::size_t>(3 * reference_rate_hz);
  const double lag_m =
      0.0855 - reference.track.states.at(at_end_of_stroke).clone.pose.position_m.x();
  EXPECT_NEAR(lag_m, steady_lag_m(0.8, 0.2, 50), 0.01e-3);
}

// Friction while pressed, a short contact, a fast one.
TEST(Reference, TwoEnginesAgree) {
  for (const char* name : {"press_slide", "tap", "swipe"}) {
    const Reference reference = reference_of(bench_scene(name), false);
    if (reference.method.find("ODE") == std::string::npos) GTEST_SKIP() << "built without ODE";
    EXPECT_LT(reference.uncertainty_mm, 0.02) << name;
    EXPECT_GT(reference.uncertainty_mm, 0) << name;
  }
}

double yaw_deg(const Pose& pose) {
  const Eigen::Vector3d x = pose.orientation * Eigen::Vector3d::UnitX();
  return std::atan2(x.y(), x.x()) * 180 / M_PI;
}

// Compliant contacts determine how a cube turns, here by 80, 12 and 54 degrees. In the last scene
// the clone turns with the cube.
TEST(Reference, TwoEnginesAgreeHowACubeTurns) {
  for (const char* name : {"offcenter_push", "corner_push", "offcenter_push_kappa0.015"}) {
    const BenchScene scene = bench_scene(name);
    auto other = make_ode_simulator();
    if (!other) GTEST_SKIP() << "built without ODE";
    const SceneTrack ode = run_scene(std::move(other), scene, 24000, reference_rate_hz).track;
    const SceneTrack ours =
        run_scene(make_simulator("boxes"), scene, 16 * reference_rate_hz, reference_rate_hz).track;
    const TrackError between = error_of(ode, ours, scene);
    EXPECT_LT(between.clone_rms_mm, 0.06) << name;
    EXPECT_LT(between.cubes_rms_mm, 0.05) << name;
    double apart_deg = 0;
    ASSERT_EQ(ode.states.size(), ours.states.size()) << name;
    for (std::size_t i = 0; i < ode.states.size(); ++i)
      apart_deg = std::max(apart_deg, std::abs(yaw_deg(ode.states[i].cubes[0].pose) -
                                               yaw_deg(ours.states[i].cubes[0].pose)));
    EXPECT_LT(apart_deg, 0.1) << name;
    const double turned_deg =
        yaw_deg(ours.states.back().cubes[0].pose) - yaw_deg(ours.states.front().cubes[0].pose);
    EXPECT_GT(std::abs(turned_deg), 10) << name;
  }
}

TEST(Reference, OfATurnIsTheOtherEnginesTooAndShowsHowOpenRigidBodiesLeaveIt) {
  const Reference reference = reference_of(bench_scene("corner_push"), false);
  if (reference.method.find("ODE") == std::string::npos) GTEST_SKIP() << "built without ODE";
  EXPECT_LT(reference.uncertainty_mm, 0.02);
  EXPECT_LT(reference.cubes_differ_mm, 0.02);
  EXPECT_GT(reference.rigid_cubes_differ_mm, 1);
}

TEST(Reference, OfAFreeReturnIsTheOscillatorsFormula) {
  const Reference reference = reference_of(bench_scene("free_return"), false);
  EXPECT_EQ(reference.method, "closed form");
  EXPECT_EQ(reference.track.states.front().clone.pose.position_m.x(), 0.03);
  const double t_s = 24.0 / reference_rate_hz;
  EXPECT_NEAR(reference.track.states[24].clone.pose.position_m.x(),
              0.03 * FreeReturn(50, 0.01, 1)(t_s), 1e-15);
}

TEST(TrackError, IsZeroForTheReferenceAndAMillimeterForAMillimeter) {
  const BenchScene scene = bench_scene("push_200g");
  SceneTrack reference = reference_of(scene, true).track;
  const TrackError none = error_of(reference, reference, scene);
  EXPECT_EQ(none.clone_rms_mm, 0);
  EXPECT_EQ(none.lag_error_g, 0);
  SceneTrack shifted = reference;
  for (WorldState& state : shifted.states) state.clone.pose.position_m.x() -= 1e-3;
  const TrackError one = error_of(shifted, reference, scene);
  EXPECT_NEAR(one.clone_rms_mm, 1, 1e-9);
  EXPECT_NEAR(one.lag_error_g, 1 / 0.157, 0.01);  // 0.157 mm a gram
  EXPECT_EQ(one.cubes_rms_mm, 0);
}

}  // namespace
}  // namespace heft
