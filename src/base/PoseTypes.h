// A rigid pose and the velocities that go with it. Reads as target_from_source: a Pose of the clone
// in the world takes clone coordinates to world coordinates. World frame: table top is z = 0, z up,
// x to the participant's right, y away from the participant, origin at the board's center.
#pragma once

#include <Eigen/Geometry>

namespace heft {

struct Pose {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();

  Eigen::Vector3d operator*(const Eigen::Vector3d& point_m) const {
    return position_m + orientation * point_m;
  }
  /// a_from_c of a_from_b and b_from_c.
  Pose operator*(const Pose& then) const {
    return {*this * then.position_m, orientation * then.orientation};
  }
  /// source_from_target.
  Pose inverse() const {
    const Eigen::Quaterniond back = orientation.conjugate();
    return {-(back * position_m), back};
  }
};

/// Linear and angular velocity in the world frame.
struct Velocity {
  Eigen::Vector3d linear_m_s = Eigen::Vector3d::Zero();
  Eigen::Vector3d angular_rad_s = Eigen::Vector3d::Zero();
};

}  // namespace heft
