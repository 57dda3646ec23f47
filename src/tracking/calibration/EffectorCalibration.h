// Measures the tags of a hand-made effector from pictures of it: the tags' poses on the effector
// and the effector's pose in each picture are adjusted together (bundle adjustment) until all
// corners project to their measured pixels. Each tag stays the flat square of its file. Pictures do
// not determine the overall size, which is fixed by the tags' printed size. Origin and axes remain
// the file's, by the corners' best rigid fit.
#pragma once

#include <string>
#include <vector>

#include "base/PoseTypes.h"
#include "tracking/calibration/TagViews.h"

namespace heft {

struct CalibratedTag {
  int id = 0;
  int n_views = 0;     ///< views that show it together with another tag
  double moved_m = 0;  ///< mean displacement of its corners from the file's
};

struct EffectorCalibration {
  MarkerBody effector;  ///< as measured
  double rms_px = 0;    ///< reprojection
  double bias_px = 0;   ///< apparent outward displacement of edges
  int n_views = 0;
  std::vector<CalibratedTag> tags;  ///< in the effector's order
};

/// The smallest number of views that determines a tag.
inline constexpr int least_views_of_a_tag = 6;

/// @param views of the effector; those with fewer than two tags are not used
/// @throws Error if there are too few, or a tag is in fewer than least_views_of_a_tag of them,
/// naming it
EffectorCalibration calibrate_effector(const MarkerBody& effector, const Intrinsics& camera,
                                       const std::vector<TagView>& views);

/// Reasons to distrust a calibration, with advice; empty if there are none.
std::vector<std::string> doubts(const EffectorCalibration& calibration);

/// Description of the result, for the top of its file.
std::string summary(const EffectorCalibration& calibration);

// Bundle adjustment of rigid tags on a body in several views, the least-squares core of the
// calibration.

struct TagBundle {
  std::vector<Pose> body_from_tag;     ///< of each tag, whose frame has x right, y up, z out
  std::vector<double> side_m;          ///< of each tag
  std::vector<Pose> camera_from_body;  ///< of each view
  double bias_px = 0;                  ///< apparent outward displacement of edges
};

/// The corner of a tag in its frame. @param corner 0 top left, then clockwise
Eigen::Vector3d corner_in_tag(double side_m, std::size_t corner);

/// Levenberg-Marquardt with Huber weights on corners in pixels. Weak priors at the start values
/// keep undetermined parameters in place without affecting others.
/// @return reprojection error, rms in pixels
double adjust(TagBundle& bundle, const Intrinsics& camera, const std::vector<TagView>& views);

}  // namespace heft
