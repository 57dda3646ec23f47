// The scenes of the physics study with the effector's paths. The files of tests/scenes/ are written
// from here, so that tests, `heft scene` and the study use the same scenes.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "base/Names.h"
#include "experiment/Trajectory.h"
#include "physics/scene/Scene.h"

namespace heft {

/// The kind of a scene, by what it requires of a simulator.
enum class SceneClass {
  free_air,  ///< nothing is touched
  push,      ///< one cube, straight, through its center
  turn,      ///< one cube that rotates
  press,     ///< against an immovable object
  several,   ///< more than one cube is touched, or cubes touch cubes
  rough      ///< fast, noisy, interrupted
};

template <>
struct EnumNames<SceneClass> {
  static constexpr std::array<std::string_view, 6> names{"free_air", "push",    "turn",
                                                         "press",    "several", "rough"};
};

struct BenchScene {
  std::string name;   ///< of its file, without extension
  std::string about;  ///< one or two sentences, the comment at the top of the file
  SceneClass kind = SceneClass::push;
  Scene scene;
  std::string path_name;  ///< of the trajectory's file; scenes may share one
  std::vector<TrajectoryRow> path;

  /// Whether the rigid solution is unique. It is not for a cube on four corners that rotates,
  /// because the distribution of its weight is indeterminate; such scenes have compliant contacts.
  bool unique_if_rigid() const { return scene.contact_compliance_m_per_n == 0; }
  double duration_s() const { return path.back().t_s - path.front().t_s; }
};

/// All of them: closed forms first, then one contact, then many. Names are unique.
std::vector<BenchScene> bench_scenes();

/// @throws Error if there is no scene of that name
BenchScene bench_scene(std::string_view name);

/// The scene file's text; reads back (protocol/SceneFile.h) as the same scene.
std::string scene_toml(const BenchScene& scene);

/// The trajectory file's text; reads back (experiment/Trajectory.h) as the same path.
std::string path_csv(const BenchScene& scene);

}  // namespace heft
