// Where rays hit a tag.
#pragma once

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <array>

#include "base/PoseTypes.h"

namespace heft {

/// A tag as a plane in the camera's frame: its border's top left corner and its cells' sides.
struct TagPlane {
  Eigen::Vector3d corner_m, right_m, down_m;
  /// Of a point: how many cells to the right and down, and 1, times its depth.
  Eigen::Matrix3d cell_of;

  TagPlane(const Pose& pose, const std::array<Eigen::Vector3d, 4>& c, int n_cells)
      : corner_m(pose * c[0]),
        right_m(pose.orientation * (c[1] - c[0]) / n_cells),
        down_m(pose.orientation * (c[3] - c[0]) / n_cells) {
    Eigen::Matrix3d sides;
    sides << right_m, down_m, corner_m;
    cell_of = sides.inverse();
  }
};

/// Where a ray hits it, and what the place on it does to the ray.
struct TagHit {
  Eigen::Vector2d cell;           ///< from the border's corner
  Eigen::Matrix2d cell_by_slant;  ///< of the ray's distance from a point, at the point's depth
  Eigen::Vector3d point_m;

  TagHit(const TagPlane& plane, const Eigen::Vector2d& ray) {
    const Eigen::Vector3d at_depth_1 = plane.cell_of.leftCols<2>() * ray + plane.cell_of.col(2);
    const double depth_m = 1 / at_depth_1.z();
    cell = depth_m * at_depth_1.head<2>();
    cell_by_slant = plane.cell_of.topLeftCorner<2, 2>() - cell * plane.cell_of.row(2).head<2>();
    point_m = depth_m * ray.homogeneous();
  }
};

}  // namespace heft
