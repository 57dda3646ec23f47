// How hard a homogeneous box is to turn.
#pragma once

#include <Eigen/Core>

namespace heft {

/// Moments of inertia about its own axes through its center, kg m^2.
inline Eigen::Vector3d box_inertia_kg_m2(double mass_kg, const Eigen::Vector3d& size_m) {
  const Eigen::Vector3d squares = size_m.cwiseAbs2();
  return mass_kg / 12 * (Eigen::Vector3d::Constant(squares.sum()) - squares);
}

}  // namespace heft
