#include "physics/boxes/Body.h"

#include <Eigen/LU>

#include "base/Pose.h"

namespace heft::boxes {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {
// Equals rotation_from_vector to 1e-13 rad after normalization, without sine and cosine.
Eigen::Quaterniond small_rotation(const Vector3d& turn_rad) {
  if (turn_rad.squaredNorm() > 1e-8) return rotation_from_vector(turn_rad);
  const Vector3d half_rad = turn_rad / 2;
  return {1, half_rad.x(), half_rad.y(), half_rad.z()};
}

bool is_isotropic(const Vector3d& inertia_kg_m2) {
  return inertia_kg_m2.maxCoeff() - inertia_kg_m2.minCoeff() <= 1e-9 * inertia_kg_m2.maxCoeff();
}
}  // namespace

void Motion::begin(double mean_weight) {
  free = constrained = {end.linear_m_s + mean_weight * (mean.linear_m_s - end.linear_m_s),
                        end.angular_rad_s + mean_weight * (mean.angular_rad_s - end.angular_rad_s)};
}

void Motion::finish(double mean_weight, bool driven) {
  const double by_end = 1 / (1 - mean_weight);
  mean.linear_m_s += mean_per_constrained * (constrained.linear_m_s - free.linear_m_s);
  end.linear_m_s = by_end * (constrained.linear_m_s - mean_weight * mean.linear_m_s);
  if (!rotates) return;
  const Vector3d change_rad_s = constrained.angular_rad_s - free.angular_rad_s;
  if (driven)
    mean.angular_rad_s += mean_rotation_per_constrained * change_rad_s;
  else
    mean.angular_rad_s += mean_per_constrained * change_rad_s;
  end.angular_rad_s = by_end * (constrained.angular_rad_s - mean_weight * mean.angular_rad_s);
}

void Body::set_size(const Vector3d& size_m) {
  shape.half_m = size_m / 2;
  radius_m = shape.half_m.norm();
}

void Body::reset(const Pose& to, const Velocity& at) {
  velocity = at;
  force_duration_s = 0;
  wake();
  set_pose(to);
}

void Body::set_pose(const Pose& at) {
  const bool turned = at.orientation.coeffs() != pose.orientation.coeffs();
  pose = at;
  shape.center_m = pose.position_m;
  if (turned) shape.axes = pose.orientation.toRotationMatrix();
}

void Body::integrate(const Velocity& at, double h_s) {
  pose.position_m += h_s * at.linear_m_s;
  shape.center_m = pose.position_m;
  if (at.angular_rad_s.isZero(0)) return;
  pose.orientation = (small_rotation(h_s * at.angular_rad_s) * pose.orientation).normalized();
  shape.axes = pose.orientation.toRotationMatrix();
}

void Body::look_ahead(double ahead_s) {
  looks_ahead_ = ahead_s > 0 && !asleep;
  if (!looks_ahead_) return;
  pose_before_ = pose;
  shape_before_ = shape;
  lead_velocity = velocity;
  if (driven && !step.rotates) lead_velocity.angular_rad_s = step.mean.angular_rad_s;
  integrate(lead_velocity, ahead_s);
}

void Body::end_look_ahead() {
  if (!looks_ahead_) return;
  pose = pose_before_;
  shape = shape_before_;
}

// A constant force changes the mean velocity by half as much as the velocity at the end.
void Body::set_free_motion(double gravity_m_s2, const StepTime& time) {
  const Vector3d velocity_gain_m_s(0, 0, -time.h_s * gravity_m_s2);
  const Vector3d angular_gain_rad_s = gyroscopic_change(time.h_s);
  const auto& [along, about] = velocity;
  step.mean = {along + velocity_gain_m_s / 2, about + angular_gain_rad_s / 2};
  step.end = {along + velocity_gain_m_s, about + angular_gain_rad_s};
  const double constrained_by_end = 1 - time.mean_weight() / 2;
  step.mean_per_constrained = 0.5 / constrained_by_end;
  step.inverse_mass = constrained_by_end / mass_kg;
  step.rotates = true;
  const Vector3d inverse_inertia = constrained_by_end * inertia_kg_m2.cwiseInverse();
  step.inverse_inertia = inverse_inertia.asDiagonal();
  if (!is_isotropic(inertia_kg_m2))
    step.inverse_inertia = shape.axes * inverse_inertia.asDiagonal() * shape.axes.transpose();
}

// Change of angular velocity by the gyroscopic term over h_s seconds: one Newton step of implicit
// Euler for Euler's equations in body axes, which never gains energy (Catto, Numerical methods, GDC
// 2015).
Vector3d Body::gyroscopic_change(double h_s) const {
  if (is_isotropic(inertia_kg_m2) || velocity.angular_rad_s.isZero(0)) return Vector3d::Zero();
  const Vector3d w = shape.axes.transpose() * velocity.angular_rad_s;
  const Vector3d l = inertia_kg_m2.cwiseProduct(w);
  const Matrix3d jacobian = Matrix3d(inertia_kg_m2.asDiagonal()) +
                            h_s * (cross_matrix(w) * inertia_kg_m2.asDiagonal() - cross_matrix(l));
  return -(shape.axes * (jacobian.inverse() * (h_s * w.cross(l))));
}

}  // namespace heft::boxes
