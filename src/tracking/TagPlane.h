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

  TagPlane(const Pose& pose, const std::array<Eigen::Vector3d, 4>& c, int n_cells)
      : corner_m(pose * c[0]),
        right_m(pose.orientation * (c[1] - c[0]) / n_cells),
        down_m(pose.orientation * (c[3] - c[0]) / n_cells) {}
};

/// Where a ray hits it, and what the place on it does to the ray.
struct TagHit {
  Eigen::Vector2d cell;           ///< from the border's corner
  Eigen::Matrix2d cell_by_slant;  ///< of the ray's distance from a point, at the point's depth
  Eigen::Vector3d point_m;

  TagHit(const TagPlane& plane, const Eigen::Vector2d& ray) {
    Eigen::Matrix2d slant;
    slant.col(0) = plane.right_m.head<2>() - ray * plane.right_m.z();
    slant.col(1) = plane.down_m.head<2>() - ray * plane.down_m.z();
    cell_by_slant = slant.inverse();
    cell = -(cell_by_slant * (plane.corner_m.head<2>() - ray * plane.corner_m.z()));
    point_m = plane.corner_m + cell.x() * plane.right_m + cell.y() * plane.down_m;
  }
};

}  // namespace heft
