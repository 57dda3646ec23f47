// What is computed with poses and velocities. Headers that only hold some include PoseTypes.h.
#pragma once

#include "base/PoseTypes.h"

namespace heft {

/// The pose a fraction s (0...1) of the way: positions linearly, orientations by the shorter slerp.
Pose interpolate(const Pose& from, const Pose& to, double s);

/// Rotation vector (axis times angle, radians, |angle| <= pi) of a unit quaternion. Uses atan2, so
/// it is exact for tiny angles too.
Eigen::Vector3d rotation_vector(const Eigen::Quaterniond& rotation);

/// Inverse of rotation_vector.
Eigen::Quaterniond rotation_from_vector(const Eigen::Vector3d& vector_rad);

/// cross_matrix(a) * b is a x b.
inline Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& a) {
  Eigen::Matrix3d m;
  m << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return m;
}

/// Mean velocity that takes `from` to `to` in dt_s seconds.
Velocity mean_velocity(const Pose& from, const Pose& to, double dt_s);

/// A pose standing on the table plane, turned by yaw_rad about z.
Pose upright_pose(const Eigen::Vector3d& position_m, double yaw_rad);

}  // namespace heft
