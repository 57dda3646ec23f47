// A body's pose from its tags' corners by OpenCV's functions, as usual chains do it.
#pragma once

#include <optional>
#include <vector>

#include "base/PoseTypes.h"
#include "tracking/detection/MarkerBody.h"
#include "tracking/detection/TagDetector.h"

namespace heft {

/// All corners of all of the body's tags, then cv::solvePnP as it is by default (iterative).
std::optional<Pose> pose_by_solvepnp(const Intrinsics& camera, const MarkerBody& body,
                                     const std::vector<DetectedTag>& tags);

/// The pose that the body's largest tag has on its own: cv::solvePnP's IPPE for squares, the better
/// of its two solutions (Collins and Bartoli, "Infinitesimal plane-based pose estimation", IJCV
/// 2014).
std::optional<Pose> pose_of_largest_tag(const Intrinsics& camera, const MarkerBody& body,
                                        const std::vector<DetectedTag>& tags);

}  // namespace heft
