#include "tracking/pose/RollingShutter.h"

#include <algorithm>

namespace heft {

namespace {
double row_s(const Intrinsics& camera, double row) {
  return camera.readout_s * std::clamp(row / camera.height_px, 0.0, 1.0);
}

// Position of a measured point on an edge, 0 at its start and 1 at its end, from the measured
// corners.
double fraction_along(const TagObservation& tag, std::size_t edge, const Eigen::Vector2d& ray) {
  const Eigen::Vector2d start = tag.rays[edge], along = tag.rays[(edge + 1) % 4] - start;
  return std::clamp((ray - start).dot(along) / along.squaredNorm(), 0.0, 1.0);
}
}  // namespace

double own_row_s(const Intrinsics& camera, const Pose& camera_from_body) {
  return row_s(camera, project(camera, camera_from_body.position_m).y());
}

RowsHeld::RowsHeld(const Intrinsics& camera, const Pose& camera_from_body, const Velocity& velocity)
    : camera_(camera),
      origin_m_(camera_from_body.position_m),
      velocity_(velocity),
      own_s_(own_row_s(camera, camera_from_body)) {}

Eigen::Vector2d RowsHeld::operator()(const Eigen::Vector2d& ray, double row,
                                     const Eigen::Vector3d& point_m) const {
  const Eigen::Vector3d moves_m_s =
      velocity_.linear_m_s + velocity_.angular_rad_s.cross(point_m - origin_m_);
  const double since_s = row_s(camera_, row) - own_s_;
  return ray - since_s / point_m.z() * (moves_m_s.head<2>() - moves_m_s.z() * ray);
}

std::vector<TagObservation> held_still(std::vector<TagObservation> tags, const Intrinsics& camera,
                                       const Pose& camera_from_body, const Velocity& velocity) {
  const RowsHeld rows(camera, camera_from_body, velocity);
  const auto held = [&](const Eigen::Vector2d& ray, const Eigen::Vector3d& point_m) {
    return rows(ray, distort(camera, ray).y(), camera_from_body * point_m);
  };
  for (TagObservation& tag : tags) {
    for (std::size_t i = 0; i < 4; ++i)
      for (Eigen::Vector2d& ray : tag.edges[i].rays) {
        const double s = fraction_along(tag, i, ray);
        ray = held(ray, (1 - s) * tag.edges[i].start_m + s * tag.edges[i].end_m);
      }
    for (std::size_t i = 0; i < 4; ++i) tag.rays[i] = held(tag.rays[i], tag.corners_m[i]);
  }
  return tags;
}

}  // namespace heft
