// Interpolation, rotation vectors and velocities of poses.
#pragma once

#include "base/PoseTypes.h"

namespace heft {

/// The pose at fraction s (0...1) between two: linear in position, shorter slerp in orientation.
Pose interpolate(const Pose& from, const Pose& to, double s);

/// Rotation vector (axis times angle, radians, |angle| <= pi) of a unit quaternion. Uses atan2,
/// which is accurate for tiny angles.
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

}  // namespace heft
