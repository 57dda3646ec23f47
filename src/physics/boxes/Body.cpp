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

Matrix3d cross_matrix(const Vector3d& v) {
  Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

bool alike(const Vector3d& inertia_kg_m2) {
  return inertia_kg_m2.maxCoeff() - inertia_kg_m2.minCoeff() <= 1e-9 * inertia_kg_m2.maxCoeff();
}
}  // namespace

void Body::set_size(const Vector3d& size_m) {
  shape.half_m = size_m / 2;
  radius_m = shape.half_m.norm();
}

void Body::put(const Pose& to, const Velocity& at) {
  velocity = at;
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
void Body::fall(double gravity_m_s2, double h_s, bool momentary) {
  const double per_kg = 1 / mass_kg;
  const Vector3d per_kg_m2 = inertia_kg_m2.cwiseInverse();
  const Matrix3d turning =
      alike(inertia_kg_m2) ? Matrix3d(per_kg_m2.asDiagonal())
                           : Matrix3d(shape.axes * per_kg_m2.asDiagonal() * shape.axes.transpose());
  const Vector3d faster_m_s(0, 0, -h_s * gravity_m_s2);
  const Vector3d turns_faster_rad_s = tumbled(h_s);
  for (const Level level : both_levels) {
    const double share = level == mean && momentary ? 0.5 : 1;
    step[level] = {{velocity.linear_m_s + share * faster_m_s,
                    velocity.angular_rad_s + share * turns_faster_rad_s},
                   share * per_kg,
                   share * turning,
                   true};
  }
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
