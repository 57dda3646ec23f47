#include "tracking/pose/OwnTags.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "tracking/detection/PlanarPose.h"

namespace heft {

namespace {
// A pose proposed by one tag puts the corners of the others this far off at most; a foreign tag is
// farther away.
constexpr double own_px = 12;
constexpr double near_m = 0.05, near_rad = 0.5;  // an expected pose is this certain

bool has_doubles(const std::vector<TagObservation>& tags) {
  std::map<std::size_t, int> times_seen;
  return std::ranges::any_of(tags,
                             [&](const TagObservation& tag) { return ++times_seen[tag.tag] > 1; });
}

// Root mean square distance of a tag's corners from their places, at most own_px.
double off_px(const TagObservation& tag, const Pose& pose) {
  double sum_px2 = 0;
  for (std::size_t i = 0; i < 4; ++i) sum_px2 += std::pow(tag.corner_off_px(i, pose), 2) / 4;
  return std::min(own_px, std::sqrt(sum_px2));
}

// For each tag of the body its observation nearest to the pose.
std::map<std::size_t, const TagObservation*> nearest_of(const std::vector<TagObservation>& tags,
                                                        const Pose& pose) {
  std::map<std::size_t, const TagObservation*> nearest;
  for (const TagObservation& tag : tags) {
    const TagObservation*& best = nearest[tag.tag];
    if (!best || off_px(tag, pose) < off_px(*best, pose)) best = &tag;
  }
  return nearest;
}

double cost_of(const std::vector<TagObservation>& tags, const Pose& pose,
               const std::optional<Pose>& expected) {
  double cost = 0;
  for (const auto& [index, tag] : nearest_of(tags, pose)) cost += std::pow(off_px(*tag, pose), 2);
  if (!expected) return cost;
  const double off = (pose.position_m - expected->position_m).norm() / near_m;
  const double turned = pose.orientation.angularDistance(expected->orientation) / near_rad;
  return cost + own_px * own_px * std::min(1.0, off * off + turned * turned);
}
}  // namespace

bool is_above(const std::optional<Pose>& camera_from_table, const Pose& camera_from_body) {
  return !camera_from_table || (camera_from_table->inverse() * camera_from_body.position_m).z() > 0;
}

std::vector<TagObservation> own_tags(const std::vector<TagObservation>& tags,
                                     const std::optional<Pose>& expected,
                                     const std::optional<Pose>& camera_from_table) {
  const bool doubled = has_doubles(tags);
  if (!doubled && !camera_from_table) return tags;
  std::vector<Pose> proposed;  // the better of each tag's two poses
  for (const TagObservation& tag : tags) {
    const auto poses = planar_poses(tag.corners_m, tag.rays);
    if (!poses.empty() && is_above(camera_from_table, poses.front()))
      proposed.push_back(poses.front());
  }
  if (proposed.size() == tags.size() && !doubled) return tags;
  std::vector<TagObservation> own;
  if (proposed.empty()) return own;
  const auto best = std::ranges::min_element(
      proposed, {}, [&](const Pose& pose) { return cost_of(tags, pose, expected); });
  for (const auto& [index, tag] : nearest_of(tags, *best))
    if (off_px(*tag, *best) < own_px) own.push_back(*tag);
  return own;
}

int n_elsewhere(const std::vector<DetectedTag>& tags, const Region& part, const Intrinsics& camera,
                const MarkerBody& body, const Pose& camera_from_body) {
  return static_cast<int>(std::ranges::count_if(tags, [&](const DetectedTag& seen) {
    const auto tag = std::ranges::find(body.tags, seen.id, &Tag::id);
    if (tag == body.tags.end()) return false;
    const Eigen::Vector3d own_m = camera_from_body * tag_center_m(*tag);
    const auto& c = seen.corners_px;
    const Eigen::Vector2d middle_px = (c[0] + c[1] + c[2] + c[3]) / 4;
    const Eigen::Vector2d in_part_px = middle_px - Eigen::Vector2d(part.x, part.y);
    if ((in_part_px.array() < 0).any() || in_part_px.x() > part.width ||
        in_part_px.y() > part.height)
      return false;
    return own_m.z() <= 0 || (project(camera, own_m) - middle_px).norm() > (c[1] - c[0]).norm() / 2;
  }));
}

}  // namespace heft
