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
}  // namespace

void Body::set_size(const Vector3d& size_m) {
  shape.half_m = size_m / 2;
  radius_m = shape.half_m.norm();
}

void Body::set_mass(double mass_kg, const Vector3d& inertia) {
  inverse_mass_per_kg = mass_kg > 0 ? 1 / mass_kg : 0;
  if (inertia == inertia_kg_m2) return;
  inertia_kg_m2 = inertia;
  turns_alike = inertia.maxCoeff() - inertia.minCoeff() <= 1e-9 * inertia.maxCoeff();
  tumbles = has_weight && !turns_alike;
  refresh_inertia();
}

void Body::put(const Pose& to, const Velocity& at) {
  velocity = at;
  fresh = true;
  wake();
  place(to);
}

void Body::place(const Pose& at) {
  const bool turns = at.orientation.coeffs() != pose.orientation.coeffs();
  pose = at;
  shape.center_m = pose.position_m;
  if (turns) turned();
}

void Body::shift(const Vector3d& by_m, const Vector3d& turn_rad) {
  pose.position_m += by_m;
  shape.center_m = pose.position_m;
  if (turn_rad.isZero(0)) return;
  pose.orientation = (small_rotation(turn_rad) * pose.orientation).normalized();
  turned();
}

void Body::move(double h_s) {
  shift(h_s * velocity.linear_m_s, h_s * velocity.angular_rad_s);
}

void Body::turned() {
  shape.axes = pose.orientation.toRotationMatrix();
  if (!turns_alike) refresh_inertia();
}

void Body::refresh_inertia() {
  if (inertia_kg_m2.x() == 0)
    inverse_inertia.setZero();
  else if (turns_alike)
    inverse_inertia = Matrix3d::Identity() / inertia_kg_m2.x();
  else
    inverse_inertia =
        shape.axes * inertia_kg_m2.cwiseInverse().asDiagonal() * shape.axes.transpose();
}

// One Newton step of Euler's equations by implicit Euler in the body's own axes: it never gains
// energy, however fast the box spins (Catto, Numerical methods, GDC 2015).
void Body::tumble(double h_s) {
  if (!tumbles) return;
  const Vector3d w = shape.axes.transpose() * velocity.angular_rad_s;
  const Vector3d l = inertia_kg_m2.cwiseProduct(w);
  const auto cross = [](const Vector3d& v) {
    Matrix3d m;
    m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
    return m;
  };
  const Matrix3d slope = Matrix3d(inertia_kg_m2.asDiagonal()) +
                         h_s * (cross(w) * inertia_kg_m2.asDiagonal() - cross(l));
  velocity.angular_rad_s = shape.axes * (w - slope.inverse() * (h_s * w.cross(l)));
}

}  // namespace heft::boxes
