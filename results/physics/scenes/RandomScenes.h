// Random scenes of simulated hands: they start and stop, sway, tremble and rotate, seen by a
// camera, among single, staggered, stacked or lined-up cubes. The known errors of a rate are
// quantiles over these scenes.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "experiment/Trajectory.h"
#include "results/physics/scenes/Scenes.h"

namespace heft {

// Paths of a hand through a scene, as rows of a trajectory.

/// The effector's center at this height clears the table by 1 mm.
inline constexpr double hand_height_m = 0.021;

/// Where the effector's center is when its tip is 2 mm before a cube at the origin.
inline constexpr double before_cube_m = -0.0645;

/// Builds a path from its corners.
class PathBuilder {
 public:
  /// Moves straight to a position, which is reached at t_s.
  PathBuilder& to(double t_s, const Eigen::Vector3d& position_m, double yaw_rad = 0);
  /// Out of view at t_s, until the next row.
  PathBuilder& lost(double t_s);
  std::vector<TrajectoryRow> rows() const { return rows_; }

 private:
  std::vector<TrajectoryRow> rows_;
};

/// Tip first through the origin at constant speed, then still for a second.
struct StraightPath {
  double heading_rad = 0;  ///< the direction of the path and of the effector
  double speed_m_s = 0.05, length_m = 0.15;
  double start_m = before_cube_m;  ///< of the effector's center, along the heading
  double side_m = 0;               ///< of the path from the line through the origin
  double turn_rad = 0;             ///< of the effector, on the way
  bool broadside = false;          ///< with the long side first

  std::vector<TrajectoryRow> rows() const;
};

/// Three soft taps of a cube at the origin, 10 mm past its face, in 1.2 s.
std::vector<TrajectoryRow> taps();

/// A straight path as a camera with noise sees it 60 times a second.
std::vector<TrajectoryRow> noisy(const StraightPath& path, double sd_m);

/// Contents of a random scene.
enum class Setting {
  straight,
  one,
  aside,
  turning,
  pair,
  staggered,
  row,
  stack,
  tower,
  thrown,
  gain,
  speed_limit,
  coupled
};

template <>
struct EnumNames<Setting> {
  static constexpr std::array<std::string_view, 13> names{
      "straight", "one",   "aside",  "turning", "pair",        "staggered", "row",
      "stack",    "tower", "thrown", "gain",    "speed_limit", "coupled"};
};

/// Whether the rigid solution is unique. It is not for a cube on four corners that rotates or
/// carries another.
constexpr bool has_one_answer(Setting setting) {
  return setting != Setting::aside && setting != Setting::turning && setting != Setting::stack &&
         setting != Setting::tower;
}

/// Of scenes with contacts that yield.
inline constexpr double random_compliance_m_per_n = 1e-4;

/// Poses a second of its path.
int poses_hz_of(const BenchScene& random_scene);

/// Scene n of a seed, equal on all machines, so that any scene can be run alone. Scenes without a
/// unique rigid solution have compliant contacts.
BenchScene random_scene(Setting setting, std::uint64_t seed, int n);
/// The same, with compliant contacts in every second scene.
BenchScene random_hands(Setting setting, std::uint64_t seed, int n);

}  // namespace heft
