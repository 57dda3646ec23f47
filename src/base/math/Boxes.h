// Whether two oriented boxes overlap.
#pragma once

#include "base/PoseTypes.h"

namespace heft {

/// Separating-axis test of two boxes given by the poses of their centers and their full sizes.
/// Touching counts as overlapping.
bool boxes_overlap(const Pose& a, const Eigen::Vector3d& size_a_m, const Pose& b,
                   const Eigen::Vector3d& size_b_m);

}  // namespace heft
