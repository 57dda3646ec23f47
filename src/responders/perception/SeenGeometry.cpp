#include "responders/perception/SeenGeometry.h"

#include <cmath>

namespace heft {

namespace {
// Accuracy of a drawn contact, about a pixel or two; strokes start further away.
constexpr double touch_tolerance_m = 0.004;

Eigen::Vector3d cube_size_m(const Stage& stage) {
  return Eigen::Vector3d::Constant(stage.cube_size_m);
}
}  // namespace

Eigen::Vector3d half_extents_m(const Eigen::Quaterniond& orientation,
                               const Eigen::Vector3d& size_m) {
  return orientation.toRotationMatrix().cwiseAbs() * size_m / 2;
}

std::optional<int> touched_cube(const Pose& clone, std::span<const Pose> cubes,
                                const Stage& stage) {
  std::optional<int> nearest;
  double nearest_gap_m = touch_tolerance_m;
  const Eigen::Quaterniond clone_from_world = clone.orientation.conjugate();
  for (std::size_t i = 0; i < cubes.size(); ++i) {
    // In the clone's frame, where the tip is the face at half its length along x.
    const Eigen::Vector3d center_m = clone_from_world * (cubes[i].position_m - clone.position_m);
    const Eigen::Vector3d reach_m =
        half_extents_m(clone_from_world * cubes[i].orientation, cube_size_m(stage)) +
        stage.effector_size_m / 2;
    const bool in_front =
        std::abs(center_m.y()) < reach_m.y() && std::abs(center_m.z()) < reach_m.z();
    const double gap_m = std::abs(center_m.x() - reach_m.x());
    if (!in_front || gap_m > nearest_gap_m) continue;
    nearest = static_cast<int>(i);
    nearest_gap_m = gap_m;
  }
  return nearest;
}

std::vector<DisplayedFrame> frames_with_touches(std::span<const DisplayedFrame> frames,
                                                const Stage& stage) {
  std::vector<DisplayedFrame> some;
  bool touched_before = false;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const DisplayedFrame& frame = frames[i];
    const bool touches =
        frame.tracked && frame.clone && touched_cube(*frame.clone, frame.cubes, stage);
    if (touches && !touched_before && i > 0) some.push_back(frames[i - 1]);
    if (touches) some.push_back(frame);
    touched_before = touches;
  }
  return some;
}

bool clear_of_others(const Footprint& area, std::span<const Pose> cubes, int but,
                     const Stage& stage) {
  for (std::size_t i = 0; i < cubes.size(); ++i) {
    if (static_cast<int>(i) == but) continue;
    const Eigen::Vector2d center_m = cubes[i].position_m.head<2>();
    const Eigen::Vector2d half_m =
        half_extents_m(cubes[i].orientation, cube_size_m(stage)).head<2>();
    const bool overlaps = ((center_m + half_m).array() > area.least_m.array()).all() &&
                          ((center_m - half_m).array() < area.most_m.array()).all();
    if (overlaps) return false;
  }
  return true;
}

}  // namespace heft
