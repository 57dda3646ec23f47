// Bundle adjustment of rigid tags on a body that is seen in several views: the least-squares core
// of EffectorCalibration.h.
#pragma once

#include <vector>

#include "base/PoseTypes.h"
#include "tracking/TagViews.h"

namespace heft {

struct TagBundle {
  std::vector<Pose> body_from_tag;     ///< of each tag; its own frame has x right, y up, z out
  std::vector<double> side_m;          ///< of each tag
  std::vector<Pose> camera_from_body;  ///< of each view
  double bias_px = 0;                  ///< edges seem moved outwards by as much
};

/// The corner of a tag in its own frame. @param corner 0 top left, then clockwise
Eigen::Vector3d corner_in_tag(double side_m, std::size_t corner);

/// Levenberg-Marquardt with Huber weights on corners in pixels. Loose springs hold the tags' places
/// and the bias to where they start: they settle what no view tells and nothing else.
/// @return reprojection error, rms in pixels
double adjust(TagBundle& bundle, const Intrinsics& camera, const std::vector<TagView>& views);

}  // namespace heft
