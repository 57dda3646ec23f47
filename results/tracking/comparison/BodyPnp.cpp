#include "results/tracking/comparison/BodyPnp.h"

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>

#include "base/PoseTypes.h"
#include "tracking/camera/ImageConversion.h"
#include "tracking/detection/MarkerBody.h"

namespace heft {

namespace {
struct Points {
  std::vector<cv::Point3d> on_body_m;
  std::vector<cv::Point2d> in_picture_px;
};

void add_tag(Points& points, const Tag& tag, const DetectedTag& seen) {
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector3d& corner = tag.corners_m[i];
    points.on_body_m.emplace_back(corner.x(), corner.y(), corner.z());
    points.in_picture_px.emplace_back(seen.corners_px[i].x(), seen.corners_px[i].y());
  }
}

double area_px2(const DetectedTag& tag) {
  const auto& c = tag.corners_px;
  const Eigen::Vector2d a = c[2] - c[0], b = c[3] - c[1];
  return std::abs(a.x() * b.y() - a.y() * b.x()) / 2;
}

std::optional<Pose> solved(const Intrinsics& camera, const Points& points, int method) {
  if (points.on_body_m.empty()) return std::nullopt;
  const cv::Matx33d matrix(camera.fx_px, 0, camera.cx_px, 0, camera.fy_px, camera.cy_px, 0, 0, 1);
  const std::vector<double> distortion(camera.distortion.begin(), camera.distortion.end());
  cv::Vec3d turn, shift;
  if (!cv::solvePnP(points.on_body_m, points.in_picture_px, matrix, distortion, turn, shift, false,
                    method))
    return std::nullopt;
  const Pose pose = pose_from(turn, shift);
  if (!pose.position_m.allFinite() || !pose.orientation.coeffs().allFinite()) return std::nullopt;
  return pose;
}
// None where the body has no such tag.
const Tag* tag_of(const MarkerBody& body, int id) {
  const auto tag = std::ranges::find(body.tags, id, &Tag::id);
  return tag == body.tags.end() ? nullptr : &*tag;
}
}  // namespace

std::optional<Pose> pose_by_solvepnp(const Intrinsics& camera, const MarkerBody& body,
                                     const std::vector<DetectedTag>& tags) {
  Points points;
  for (const DetectedTag& seen : tags)
    if (const Tag* tag = tag_of(body, seen.id)) add_tag(points, *tag, seen);
  return solved(camera, points, cv::SOLVEPNP_ITERATIVE);
}

std::optional<Pose> pose_of_largest_tag(const Intrinsics& camera, const MarkerBody& body,
                                        const std::vector<DetectedTag>& tags) {
  const DetectedTag* largest = nullptr;
  for (const DetectedTag& seen : tags)
    if (tag_of(body, seen.id) && (!largest || area_px2(seen) > area_px2(*largest))) largest = &seen;
  if (!largest) return std::nullopt;
  const Tag& tag = *tag_of(body, largest->id);
  const double half_m = (tag.corners_m[1] - tag.corners_m[0]).norm() / 2;
  // The order of corners that cv::SOLVEPNP_IPPE_SQUARE wants.
  const Tag flat{
      0,
      {{{-half_m, half_m, 0}, {half_m, half_m, 0}, {half_m, -half_m, 0}, {-half_m, -half_m, 0}}}};
  Points points;
  add_tag(points, flat, *largest);
  const auto camera_from_tag = solved(camera, points, cv::SOLVEPNP_IPPE_SQUARE);
  if (!camera_from_tag) return std::nullopt;
  return *camera_from_tag * body_from_tag(tag).inverse();
}

}  // namespace heft
