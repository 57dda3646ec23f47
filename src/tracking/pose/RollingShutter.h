// Rolling shutter: row r of R is read at t + readout * r / R, where t is the picture's capture
// time. Moving objects are sheared and stretched by millimeters.
#pragma once

#include <vector>

#include "base/PoseTypes.h"
#include "tracking/pose/BodyPose.h"

namespace heft {

/// Delay from the first row to the one through the body's origin, seconds.
double own_row_s(const Intrinsics& camera, const Pose& camera_from_body);

/// Rays corrected to the time of the body's own row.
class RowsHeld {
 public:
  /// @param velocity of the body's origin, in the camera's frame
  RowsHeld(const Intrinsics& camera, const Pose& camera_from_body, const Velocity& velocity);

  /// @param ray of a pixel's row  @param point_m on the body, in the camera's frame
  Eigen::Vector2d operator()(const Eigen::Vector2d& ray, double row,
                             const Eigen::Vector3d& point_m) const;

 private:
  Intrinsics camera_;
  Eigen::Vector3d origin_m_;
  Velocity velocity_;
  double own_s_;
};

/// Observations of a moving body, corrected to the time when its origin is read: each point is
/// moved back along the motion of its part of the body since then.
/// @param camera_from_body accurate to some millimeters
/// @param velocity of the body's origin, in the camera's frame; constant while the body's rows are
/// read
std::vector<TagObservation> held_still(std::vector<TagObservation> tags, const Intrinsics& camera,
                                       const Pose& camera_from_body, const Velocity& velocity);

}  // namespace heft
