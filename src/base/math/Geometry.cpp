#include "base/math/Geometry.h"

#include <cmath>

namespace heft {

bool boxes_overlap(const Pose& a, const Eigen::Vector3d& size_a_m, const Pose& b,
                   const Eigen::Vector3d& size_b_m) {
  const Eigen::Matrix3d axes_a = a.orientation.toRotationMatrix();
  const Eigen::Matrix3d axes_b = b.orientation.toRotationMatrix();
  const Eigen::Vector3d between_m = b.position_m - a.position_m;
  const auto separates = [&](const Eigen::Vector3d& axis) {
    if (axis.squaredNorm() < 1e-12) return false;  // parallel edges span no plane
    const double reach_m = (axes_a.transpose() * axis).cwiseAbs().dot(size_a_m / 2) +
                           (axes_b.transpose() * axis).cwiseAbs().dot(size_b_m / 2);
    return std::abs(between_m.dot(axis)) > reach_m;
  };
  for (int i = 0; i < 3; ++i) {
    if (separates(axes_a.col(i)) || separates(axes_b.col(i))) return false;
    for (int j = 0; j < 3; ++j)
      if (separates(axes_a.col(i).cross(axes_b.col(j)))) return false;
  }
  return true;
}

}  // namespace heft
