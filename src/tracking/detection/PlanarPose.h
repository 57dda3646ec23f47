// Poses of a flat tag from its four corners, the start of every pose search.
#pragma once

#include <array>
#include <vector>

#include "base/PoseTypes.h"

namespace heft {

/// The homography from the unit square's corners (0,0), (1,0), (1,1), (0,1) to these
/// (Heckbert, "Fundamentals of texture mapping", 1989, eq. 3.14 ff.).
Eigen::Matrix3d square_to(const std::array<Eigen::Vector2d, 4>& corners);

/// Up to two fitting poses (camera from the corners' frame), the better one first: a flat object
/// seen from afar is ambiguous (Collins & Bartoli, "Infinitesimal plane-based pose estimation",
/// IJCV 2014). None for corners that cannot be a tag's picture.
/// @param corners_m in one plane  @param rays of the corners, without distortion
std::vector<Pose> planar_poses(const std::array<Eigen::Vector3d, 4>& corners_m,
                               const std::array<Eigen::Vector2d, 4>& rays);

}  // namespace heft
