// Where a hand-made effector's tags really are, from pictures of it: the tags' places on the
// effector and the effector's pose in each picture are adjusted together (bundle adjustment) until
// all corners project to where they were measured. Each tag stays the flat square that its file
// says; overall size can't be told from pictures, so that the tags' printed size fixes it. Origin
// and axes stay those of the file: the corners' best rigid fit.
#pragma once

#include <string>
#include <vector>

#include "base/PoseTypes.h"
#include "tracking/calibration/TagViews.h"

namespace heft {

struct CalibratedTag {
  int id = 0;
  int n_views = 0;     ///< that show it together with another tag
  double moved_m = 0;  ///< mean way of its corners from where the file had them
};

struct EffectorCalibration {
  MarkerBody effector;  ///< as measured
  double rms_px = 0;    ///< reprojection
  double bias_px = 0;   ///< by which edges seemed moved outwards
  int n_views = 0;
  std::vector<CalibratedTag> tags;  ///< in the effector's order
};

/// The smallest number of views that a tag needs to be placed.
inline constexpr int least_views_of_a_tag = 6;

/// @param views of the effector; those with fewer than two tags don't count
/// @throws Error when there are too few, or a tag is in fewer than least_views_of_a_tag of them,
///   naming it
EffectorCalibration calibrate_effector(const MarkerBody& effector, const Intrinsics& camera,
                                       const std::vector<TagView>& views);

/// Why a calibration should not be trusted and what to do about it; empty: it can be.
std::vector<std::string> doubts(const EffectorCalibration& calibration);

/// How the result came about, for the top of its file.
std::string summary(const EffectorCalibration& calibration);

// Bundle adjustment of rigid tags on a body that is seen in several views: the least-squares core
// of EffectorCalibration.h.

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
