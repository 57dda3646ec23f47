// A rolling shutter reads its rows one after the other: row r of R at t + readout * r / R, t being
// the picture's capture time. What moves meanwhile leans, shears and stretches, by millimeters.
#pragma once

#include <vector>

#include "base/PoseTypes.h"
#include "tracking/pose/BodyPose.h"

namespace heft {

/// How long after the first row the one through the body's origin is read, seconds.
double own_row_s(const Intrinsics& camera, const Pose& camera_from_body);

/// Rays as they would have been at the time of the body's own row.
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

/// What was measured of a moving body, as if all of it had been seen when its own row was read:
/// each point goes back by the way that its part of the body has moved since.
/// @param camera_from_body good to some millimeters
/// @param velocity of the body's origin, in the camera's frame; steady while the body's rows are
/// read
std::vector<TagObservation> held_still(std::vector<TagObservation> tags, const Intrinsics& camera,
                                       const Pose& camera_from_body, const Velocity& velocity);

}  // namespace heft
