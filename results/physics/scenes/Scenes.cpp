#include "results/physics/scenes/Scenes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/Error.h"
#include "base/Pose.h"
#include "results/physics/scenes/RandomScenes.h"

namespace heft {

namespace {
using Scenes = std::vector<BenchScene>;

Cube cube_of(double mass_kg, double x_m = 0, double y_m = 0, double yaw_rad = 0) {
  Cube cube;
  cube.mass_kg = mass_kg;
  cube.position_m = {x_m, y_m, 0.0175};
  cube.yaw_rad = yaw_rad;
  return cube;
}

Scene scene_of(std::vector<Cube> cubes) {
  Scene scene;
  scene.cubes = std::move(cubes);
  return scene;
}

const StraightPath steady;  // slow and long, so that the start has decayed

void add_free_returns(Scenes& scenes) {
  const auto hold = PathBuilder().to(0, {0, 0, 0.2}).to(0.5, {0, 0, 0.2}).rows();
  Scene shifted;
  shifted.clone_offset.position_m.x() = 0.030;
  scenes.push_back({"free_return",
                    "The clone 30 mm ahead of a still effector, released at rest; hold.csv keeps "
                    "the effector in the air. x(t) = x0 (1 + w t) e^(-w t), w = sqrt(k / m).",
                    SceneClass::free_air, shifted, "hold", hold});
  Scene turned;
  turned.coupling.torsional_stiffness_nm_per_rad = 0.005;
  turned.clone_offset.orientation = rotation_from_vector({0, 0, 0.4});
  scenes.push_back(
      {"free_return_rotation",
       "The clone turned by 0.4 rad and released at rest, with a torsional spring soft "
       "enough to see: theta(t) = theta0 (1 + w t) e^(-w t), w = sqrt(kappa / I).",
       SceneClass::free_air, turned, "hold", hold});
}

void add_straight_pushes(Scenes& scenes) {
  for (int degrees : {0, 30, 45}) {
    StraightPath path = steady;
    path.heading_rad = degrees * M_PI / 180;
    const std::string angle = degrees == 0 ? "" : fmt::format("_{}deg", degrees);
    for (int mass_g : {15, 200, 800, 1500}) {
      const std::string about = fmt::format(
          "One cube of {} g on the table, with the paper's coupling. push{}.csv pushes "
          "it {}.",
          mass_g, angle, degrees == 0 ? "along x" : fmt::format("at {} degrees to x", degrees));
      scenes.push_back({fmt::format("push_{}g{}", mass_g, angle), about,
                        mass_g > 800 ? SceneClass::press : SceneClass::push,
                        scene_of({cube_of(mass_g / 1000.0, 0, 0, path.heading_rad)}),
                        "push" + angle, path.rows()});
    }
  }
}

void add_stiffness_decades(Scenes& scenes) {
  for (double k : {0.5, 5.0, 500.0, 5000.0, 50000.0}) {
    Scene scene = scene_of({cube_of(0.015)});
    scene.coupling.stiffness_n_per_m = k;
    scenes.push_back({fmt::format("push_15g_k{}", k),
                      fmt::format("push_15g with a spring of {} N/m.", k), SceneClass::push, scene,
                      "push", steady.rows()});
  }
  StraightPath path = steady;
  path.side_m = 0.025;
  path.length_m = 0.1;
  for (double kappa : {1.5e-4, 1.5e-2, 1.5, 1.5e4}) {
    Scene scene = scene_of({cube_of(0.2)});
    scene.coupling.torsional_stiffness_nm_per_rad = kappa;
    scene.contact_compliance_m_per_n = 1e-4;
    scenes.push_back({fmt::format("offcenter_push_kappa{}", kappa),
                      fmt::format("offcenter_push with a torsional spring of {} N m/rad.", kappa),
                      SceneClass::turn, scene, "offcenter_push", path.rows()});
  }
}

void add_turns(Scenes& scenes) {
  const auto soft = [](const Cube& cube) {
    Scene scene = scene_of({cube});
    scene.contact_compliance_m_per_n = 1e-4;
    return scene;
  };
  StraightPath aside = steady;
  aside.side_m = 0.025;
  aside.length_m = 0.1;
  scenes.push_back({"offcenter_push",
                    "A cube of 200 g pushed 25 mm beside its center: it turns. Rigid bodies leave "
                    "open how its four corners share its weight, and with it how it turns.",
                    SceneClass::turn, soft(cube_of(0.2)), "offcenter_push", aside.rows()});
  StraightPath turning = steady;
  turning.turn_rad = 0.4;
  turning.length_m = 0.1;
  turning.start_m = -0.0725;
  scenes.push_back(
      {"corner_push",
       "A cube of 200 g, standing at 0.6 rad, pushed at its corner by an effector that "
       "turns by 0.4 rad. Not unique for rigid bodies, as offcenter_push.",
       SceneClass::turn, soft(cube_of(0.2, 0, 0, 0.6)), "corner_push", turning.rows()});
}

void add_presses(Scenes& scenes) {
  scenes.push_back({"tap", "A cube of 200 g tapped three times.", SceneClass::press,
                    scene_of({cube_of(0.2)}), "tap", taps()});
  const auto slide = PathBuilder()
                         .to(0, {-0.0745, 0, hand_height_m})
                         .to(0.4, {-0.0425, 0, hand_height_m})
                         .to(1.6, {-0.0425, 0.08, hand_height_m})
                         .to(2.2, {-0.0425, 0.08, hand_height_m})
                         .rows();
  scenes.push_back(
      {"press_slide",
       "The effector presses 20 mm into a cube that does not move, then slides off its "
       "edge.",
       SceneClass::press, scene_of({cube_of(1000)}), "press_slide", slide});
  const auto squeeze = PathBuilder()
                           .to(0, {0, 0, 0.060})
                           .to(0.3, {0, 0, 0.045})
                           .to(0.8, {0, 0, 0.045})
                           .to(1.1, {0, 0, 0.060})
                           .to(1.3, {0, 0, 0.060})
                           .rows();
  scenes.push_back({"squeeze", "A cube of 200 g pressed against the table from above by 10 mm.",
                    SceneClass::press, scene_of({cube_of(0.2)}), "squeeze", squeeze});
}

void add_several(Scenes& scenes) {
  const auto sweep = PathBuilder()
                         .to(0, {-0.0395, 0, hand_height_m}, M_PI / 2)
                         .to(1, {0.0605, 0, hand_height_m}, M_PI / 2)
                         .to(2, {0.0605, 0, hand_height_m}, M_PI / 2)
                         .rows();
  scenes.push_back({"sweep_three",
                    "Three cubes of 15, 200 and 100 g pushed together by the effector's long side.",
                    SceneClass::several,
                    scene_of({cube_of(0.015, 0, -0.04), cube_of(0.2, 0, 0), cube_of(0.1, 0, 0.04)}),
                    "sweep_three", sweep});
  Scene coupled = scene_of({cube_of(0.015, 0, -0.08), cube_of(0.2), cube_of(0.8, 0, 0.08)});
  coupled.coupling.decoupled = false;
  scenes.push_back(
      {"three_cubes_c1",
       "The sorting task's three cubes with a coupled clone: nothing shows their masses.",
       SceneClass::push, coupled, "push", steady.rows()});
  const auto pair = [&](const char* name, const char* about, double near_kg, double far_kg) {
    scenes.push_back({name, about, SceneClass::several,
                      scene_of({cube_of(near_kg), cube_of(far_kg, 0.055)}), "push", steady.rows()});
  };
  pair("cube_into_cube", "A cube of 15 g pushed into one of 100 g, 20 mm behind it.", 0.015, 0.1);
  pair("ratio_1_100", "A cube of 10 g pushed into one of 1 kg.", 0.010, 1);
  pair("ratio_1_1000", "A cube of 1 g pushed into one of 1 kg.", 0.001, 1);
}

void add_rough(Scenes& scenes) {
  StraightPath swipe;
  swipe.speed_m_s = 2;
  swipe.length_m = 0.5;
  swipe.start_m = -0.3;
  scenes.push_back({"swipe", "A cube of 200 g hit at 2 m/s.", SceneClass::rough,
                    scene_of({cube_of(0.2)}), "swipe", swipe.rows()});
  StraightPath brisk;
  brisk.speed_m_s = 0.1;
  scenes.push_back({"noise",
                    "push_200g at 0.1 m/s as a camera sees it at 60 Hz with 0.3 mm of noise.",
                    SceneClass::rough, scene_of({cube_of(0.2)}), "noise", noisy(brisk, 0.0003)});
  const auto jump = PathBuilder()
                        .to(0, {before_cube_m, 0, hand_height_m})
                        .to(1, {-0.0145, 0, hand_height_m})
                        .lost(1.05)
                        .to(1.1, {0.1855, 0, hand_height_m})
                        .to(2.6, {0.0855, 0, hand_height_m})
                        .rows();
  scenes.push_back({"pose_jump",
                    "The effector is lost while it pushes a cube of 200 g, is found again 0.1 s "
                    "later 20 cm farther, and comes back.",
                    SceneClass::rough, scene_of({cube_of(0.2)}), "pose_jump", jump});
}
}  // namespace

std::vector<BenchScene> bench_scenes() {
  Scenes scenes;
  add_free_returns(scenes);
  add_straight_pushes(scenes);
  add_presses(scenes);
  add_turns(scenes);
  add_several(scenes);
  add_rough(scenes);
  add_stiffness_decades(scenes);
  return scenes;
}

BenchScene bench_scene(std::string_view name) {
  const Scenes scenes = bench_scenes();
  const auto found = std::ranges::find(scenes, name, &BenchScene::name);
  if (found == scenes.end()) throw Error(fmt::format("the bench has no scene {}", name));
  return *found;
}

}  // namespace heft
