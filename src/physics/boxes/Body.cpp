#include "physics/boxes/Body.h"

#include <Eigen/LU>

#include "base/Pose.h"

namespace heft::boxes {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {
// The same as rotation_from_vector to 1e-13 rad, once normalized, without sine and cosine.
Eigen::Quaterniond small_rotation(const Vector3d& turn_rad) {
  if (turn_rad.squaredNorm() > 1e-8) return rotation_from_vector(turn_rad);
  const Vector3d half_rad = turn_rad / 2;
  return {1, half_rad.x(), half_rad.y(), half_rad.z()};
}

bool alike(const Vector3d& inertia_kg_m2) {
  return inertia_kg_m2.maxCoeff() - inertia_kg_m2.minCoeff() <= 1e-9 * inertia_kg_m2.maxCoeff();
}
}  // namespace

void Motion::begin(double mean_weight) {
  free = ahead = {end.linear_m_s + mean_weight * (mean.linear_m_s - end.linear_m_s),
                  end.angular_rad_s + mean_weight * (mean.angular_rad_s - end.angular_rad_s)};
}

void Motion::finish(double mean_weight, bool driven) {
  const double by_end = 1 / (1 - mean_weight);
  mean.linear_m_s += mean_by_ahead * (ahead.linear_m_s - free.linear_m_s);
  end.linear_m_s = by_end * (ahead.linear_m_s - mean_weight * mean.linear_m_s);
  if (!turns) return;
  const Vector3d turned_rad_s = ahead.angular_rad_s - free.angular_rad_s;
  if (driven)
    mean.angular_rad_s += mean_turn_by_ahead * turned_rad_s;
  else
    mean.angular_rad_s += mean_by_ahead * turned_rad_s;
  end.angular_rad_s = by_end * (ahead.angular_rad_s - mean_weight * mean.angular_rad_s);
}

void Body::set_size(const Vector3d& size_m) {
  shape.half_m = size_m / 2;
  radius_m = shape.half_m.norm();
}

void Body::put(const Pose& to, const Velocity& at) {
  velocity = at;
  pushed_s = 0;
  wake();
  place(to);
}

void Body::place(const Pose& at) {
  const bool turned = at.orientation.coeffs() != pose.orientation.coeffs();
  pose = at;
  shape.center_m = pose.position_m;
  if (turned) shape.axes = pose.orientation.toRotationMatrix();
}

void Body::move(const Velocity& at, double h_s) {
  pose.position_m += h_s * at.linear_m_s;
  shape.center_m = pose.position_m;
  if (at.angular_rad_s.isZero(0)) return;
  pose.orientation = (small_rotation(h_s * at.angular_rad_s) * pose.orientation).normalized();
  shape.axes = pose.orientation.toRotationMatrix();
}

// A steady push changes the mean velocity by half of what it changes the velocity at the end by.
void Body::fall(double gravity_m_s2, const StepTime& time) {
  const Vector3d faster_m_s(0, 0, -time.h_s * gravity_m_s2);
  const Vector3d turns_faster_rad_s = tumbled(time.h_s);
  const auto& [along, about] = velocity;
  step.mean = {along + faster_m_s / 2, about + turns_faster_rad_s / 2};
  step.end = {along + faster_m_s, about + turns_faster_rad_s};
  const double ahead_by_end = 1 - time.mean_weight() / 2;
  step.mean_by_ahead = 0.5 / ahead_by_end;
  step.per_kg = ahead_by_end / mass_kg;
  step.turns = true;
  const Vector3d per_kg_m2 = ahead_by_end * inertia_kg_m2.cwiseInverse();
  step.per_kg_m2 = per_kg_m2.asDiagonal();
  if (!alike(inertia_kg_m2))
    step.per_kg_m2 = shape.axes * per_kg_m2.asDiagonal() * shape.axes.transpose();
}

// The change of angular velocity over h_s seconds in which nothing turns it: one Newton step of
// Euler's equations by implicit Euler in the body's own axes, which never gains energy, however
// fast the box spins (Catto, Numerical methods, GDC 2015).
Vector3d Body::tumbled(double h_s) const {
  if (alike(inertia_kg_m2) || velocity.angular_rad_s.isZero(0)) return Vector3d::Zero();
  const Vector3d w = shape.axes.transpose() * velocity.angular_rad_s;
  const Vector3d l = inertia_kg_m2.cwiseProduct(w);
  const Matrix3d slope = Matrix3d(inertia_kg_m2.asDiagonal()) +
                         h_s * (cross_matrix(w) * inertia_kg_m2.asDiagonal() - cross_matrix(l));
  return -(shape.axes * (slope.inverse() * (h_s * w.cross(l))));
}

}  // namespace heft::boxes
