#include "physics/boxes/Body.h"

#include <Eigen/LU>

namespace heft::boxes {

using Eigen::Matrix3d;
using Eigen::Vector3d;

void Body::set_mass(double mass_kg, const Vector3d& inertia) {
  inverse_mass_per_kg = mass_kg > 0 ? 1 / mass_kg : 0;
  inertia_kg_m2 = inertia;
  turns_alike = inertia.maxCoeff() - inertia.minCoeff() <= 1e-9 * inertia.maxCoeff();
  tumbles = has_weight && !turns_alike;
  refresh();
}

void Body::put(const Pose& to, const Velocity& at) {
  pose = to;
  velocity = at;
  fresh = true;
  wake();
  refresh();
}

void Body::place(const Pose& at) {
  pose = at;
  refresh();
}

void Body::shift(const Vector3d& by_m, const Vector3d& turn_rad) {
  pose.position_m += by_m;
  if (!turn_rad.isZero(0))
    pose.orientation = (rotation_from_vector(turn_rad) * pose.orientation).normalized();
  refresh();
}

void Body::move(double h_s) {
  shift(h_s * velocity.linear_m_s, h_s * velocity.angular_rad_s);
}

void Body::refresh() {
  shape.half_m = size_m / 2;
  shape.center_m = pose.position_m;
  shape.axes = pose.orientation.toRotationMatrix();
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
