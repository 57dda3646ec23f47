// Rigid pose and velocity. A pose is named target_from_source: world_from_clone takes clone
// coordinates to world coordinates. World frame: origin at the board's center, table top at z = 0,
// z up, x to the participant's right, y away from the participant.
#pragma once

#include <Eigen/Geometry>

namespace heft {

struct Pose {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();

  Eigen::Vector3d operator*(const Eigen::Vector3d& point_m) const;
  /// a_from_c = a_from_b * b_from_c
  Pose operator*(const Pose& then) const;
  /// source_from_target
  Pose inverse() const;
};

/// A pose at that position, turned by yaw_rad about the vertical axis.
Pose upright_pose(const Eigen::Vector3d& position_m, double yaw_rad);

/// Linear and angular velocity in the world frame.
struct Velocity {
  Eigen::Vector3d linear_m_s = Eigen::Vector3d::Zero();
  Eigen::Vector3d angular_rad_s = Eigen::Vector3d::Zero();
};

}  // namespace heft
