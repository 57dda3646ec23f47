#include "tracking/calibration/EffectorCalibration.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "base/Error.h"
#include "base/Names.h"
#include "tracking/calibration/CameraCalibration.h"
#include "tracking/detection/MarkerBody.h"
#include "tracking/detection/PlanarPose.h"

namespace heft {

namespace {
double side_m(const Tag& tag) {
  double sum = 0;
  for (std::size_t c = 0; c < 4; ++c) sum += (tag.corners_m[(c + 1) % 4] - tag.corners_m[c]).norm();
  return sum / 4;
}

// Misfit of a view's corners for a pose, with a limit per corner, so that one wrong tag does not
// decide.
double misfit(const MarkerBody& effector, const Intrinsics& camera, const TagView& view,
              const Pose& camera_from_body) {
  constexpr double limit_px = 20;
  double sum = 0;
  for (const SeenTag& seen : view.tags)
    for (std::size_t c = 0; c < 4; ++c) {
      const Eigen::Vector3d p = camera_from_body * effector.tags[seen.tag].corners_m[c];
      const double off_px = p.z() > 0 ? (project(camera, p) - seen.corners_px[c]).norm() : limit_px;
      sum += std::min(off_px, limit_px);
    }
  return sum;
}

// The pose, among those that single tags of the view allow, that fits all tags best.
Pose first_pose(const MarkerBody& effector, const Intrinsics& camera, const TagView& view) {
  Pose best;
  double least = std::numeric_limits<double>::infinity();
  for (const SeenTag& seen : view.tags) {
    std::array<Eigen::Vector2d, 4> rays;
    std::ranges::transform(seen.corners_px, rays.begin(),
                           [&](const Eigen::Vector2d& px) { return undistort(camera, px); });
    for (const Pose& pose : planar_poses(effector.tags[seen.tag].corners_m, rays)) {
      const double sum = misfit(effector, camera, view, pose);
      if (sum < least) best = pose, least = sum;
    }
  }
  return best;
}

TagBundle first_guess(const MarkerBody& effector, const Intrinsics& camera,
                      const std::vector<TagView>& views) {
  TagBundle bundle;
  for (const Tag& tag : effector.tags) {
    bundle.body_from_tag.push_back(body_from_tag(tag));
    bundle.side_m.push_back(side_m(tag));
  }
  for (const TagView& view : views)
    bundle.camera_from_body.push_back(first_pose(effector, camera, view));
  return bundle;
}

std::vector<Tag> tags_of(const TagBundle& bundle, const MarkerBody& effector) {
  std::vector<Tag> tags = effector.tags;
  for (std::size_t i = 0; i < tags.size(); ++i)
    for (std::size_t c = 0; c < 4; ++c)
      tags[i].corners_m[c] = bundle.body_from_tag[i] * corner_in_tag(bundle.side_m[i], c);
  return tags;
}

// Moves all tags together to fit the file's positions best.
void back_to_axes(std::vector<Tag>& tags, const std::vector<Tag>& nominal) {
  const auto n = static_cast<Eigen::Index>(4 * tags.size());
  Eigen::Matrix3Xd from(3, n), to(3, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto tag = static_cast<std::size_t>(i / 4), corner = static_cast<std::size_t>(i % 4);
    from.col(i) = tags[tag].corners_m[corner];
    to.col(i) = nominal[tag].corners_m[corner];
  }
  const Eigen::Isometry3d rigid(Eigen::umeyama(from, to, false));
  for (Tag& tag : tags)
    for (Eigen::Vector3d& corner_m : tag.corners_m) corner_m = rigid * corner_m;
}

std::vector<CalibratedTag> seen_tags(const MarkerBody& effector,
                                     const std::vector<TagView>& views) {
  std::vector<CalibratedTag> tags;
  for (const Tag& tag : effector.tags) tags.push_back({tag.id, 0, 0});
  for (const TagView& view : views)
    for (const SeenTag& seen : view.tags) ++tags[seen.tag].n_views;
  return tags;
}

// Tags that were seen beside another one too rarely: "33, 34 (in 0 and 2 pictures)".
std::string seldom_seen(const std::vector<CalibratedTag>& tags) {
  std::vector<int> ids, counts;
  for (const CalibratedTag& tag : tags)
    if (tag.n_views < least_views_of_a_tag) {
      ids.push_back(tag.id);
      counts.push_back(tag.n_views);
    }
  if (ids.empty()) return "";
  return fmt::format("{} (pictures: {})", fmt::join(ids, ", "), fmt::join(counts, ", "));
}

void require_enough(const std::vector<CalibratedTag>& tags, std::size_t n_views) {
  constexpr std::size_t least = 10;
  const std::string seldom = seldom_seen(tags);
  if (n_views < least)
    throw Error(
        fmt::format("two or more of the effector's tags are clear in {}, expected in at least {} "
                    "and better 40; too rarely beside another tag: {}. Turn it slowly close to "
                    "the camera, in good light; check the effector file",
                    counted(static_cast<std::int64_t>(n_views), "picture"), least, seldom));
  if (!seldom.empty())
    throw Error(fmt::format(
        "too few pictures show tag {} beside another tag; expected {} or more of each. "
        "Show them with their neighbors, or remove a tag that is not on the effector from its file",
        seldom, least_views_of_a_tag));
}
}  // namespace

EffectorCalibration calibrate_effector(const MarkerBody& effector, const Intrinsics& camera,
                                       const std::vector<TagView>& views) {
  std::vector<TagView> useful;
  std::ranges::copy_if(views, std::back_inserter(useful),
                       [](const TagView& view) { return view.tags.size() >= 2; });
  EffectorCalibration result{effector, 0, 0, static_cast<int>(useful.size()),
                             seen_tags(effector, useful)};
  require_enough(result.tags, useful.size());
  TagBundle bundle = first_guess(effector, camera, useful);
  result.rms_px = adjust(bundle, camera, useful);
  result.bias_px = bundle.bias_px;
  result.effector.tags = tags_of(bundle, effector);
  back_to_axes(result.effector.tags, effector.tags);
  for (std::size_t i = 0; i < result.tags.size(); ++i)
    for (std::size_t c = 0; c < 4; ++c)
      result.tags[i].moved_m +=
          (result.effector.tags[i].corners_m[c] - effector.tags[i].corners_m[c]).norm() / 4;
  return result;
}

std::vector<std::string> doubts(const EffectorCalibration& calibration) {
  constexpr double good_rms_px = 0.3, far_m = 0.005;
  std::vector<std::string> list;
  for (const CalibratedTag& tag : calibration.tags) {
    if (tag.moved_m > far_m)
      list.push_back(
          fmt::format("tag {} is {:.1f} mm from its place in the file; check its face and "
                      "orientation",
                      tag.id, tag.moved_m * 1e3));
  }
  if (calibration.rms_px > good_rms_px)
    list.push_back(
        fmt::format("corners are {:.2f} px off (rms), expected {} or less; check that the tags are "
                    "flat, the picture sharp, and the camera's file right",
                    calibration.rms_px, good_rms_px));
  return list;
}

std::string summary(const EffectorCalibration& calibration) {
  std::string text = fmt::format("{} pictures with two tags or more, reprojection {:.3f} px rms\n",
                                 calibration.n_views, calibration.rms_px);
  for (const CalibratedTag& tag : calibration.tags)
    text += fmt::format("tag {}: in {} of them, {:.2f} mm from its place in the file\n", tag.id,
                        tag.n_views, tag.moved_m * 1e3);
  return text + verdict_of(doubts(calibration));
}

}  // namespace heft
