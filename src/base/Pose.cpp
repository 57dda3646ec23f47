#include "base/Pose.h"

#include <cmath>

namespace heft {

Eigen::Vector3d Pose::operator*(const Eigen::Vector3d& point_m) const {
  return position_m + orientation * point_m;
}

Pose Pose::operator*(const Pose& then) const {
  return {*this * then.position_m, orientation * then.orientation};
}

Pose Pose::inverse() const {
  const Eigen::Quaterniond back = orientation.conjugate();
  return {-(back * position_m), back};
}

Pose upright_pose(const Eigen::Vector3d& position_m, double yaw_rad) {
  return {position_m, Eigen::Quaterniond(Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()))};
}

Pose interpolate(const Pose& from, const Pose& to, double s) {
  return {from.position_m + s * (to.position_m - from.position_m),
          from.orientation.slerp(s, to.orientation)};
}

Eigen::Vector3d rotation_vector(const Eigen::Quaterniond& rotation) {
  const double sign = rotation.w() < 0 ? -1 : 1;  // q and -q are one rotation; take the shorter
  const Eigen::Vector3d v = sign * rotation.vec();
  const double sine = v.norm();
  if (sine < 1e-12) return 2 * v;
  return v * (2 * std::atan2(sine, sign * rotation.w()) / sine);
}

Eigen::Quaterniond rotation_from_vector(const Eigen::Vector3d& vector_rad) {
  const double angle = vector_rad.norm();
  if (angle < 1e-12) {
    const Eigen::Vector3d half = vector_rad / 2;
    return Eigen::Quaterniond(1, half.x(), half.y(), half.z()).normalized();
  }
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, vector_rad / angle));
}

Velocity mean_velocity(const Pose& from, const Pose& to, double dt_s) {
  const Eigen::Vector3d linear_m_s = (to.position_m - from.position_m) / dt_s;
  // Most steps do not rotate; the angle would cost more than the rest of the function.
  if (from.orientation.coeffs() == to.orientation.coeffs())
    return {linear_m_s, Eigen::Vector3d::Zero()};
  return {linear_m_s, rotation_vector(to.orientation * from.orientation.conjugate()) / dt_s};
}

}  // namespace heft
