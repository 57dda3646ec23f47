#include "view/scene/Viewpoint.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace heft {

namespace {
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::Vector4d;

constexpr std::size_t table_limit = 5;
constexpr double nearest_m = 0.02;          // distance from the lens below which nothing is drawn
constexpr double table_tolerance_m = 1e-4;  // keeps rounding from hiding points on the table
constexpr double straight_enough_px = 0.1;
constexpr int most_pieces = 8;

// The rays through the frame's border bound the view. Beyond them the distortion's polynomial is
// meaningless and may fold distant points back into the frame.
struct RayBounds {
  Vector2d low{1e9, 1e9}, high{-1e9, -1e9};
};

RayBounds ray_bounds(const Intrinsics& camera) {
  constexpr int n_steps = 16;
  RayBounds bounds;
  const auto include = [&](double s, double t) {
    const Vector2d ray = undistort(camera, {s * camera.width_px - 0.5, t * camera.height_px - 0.5});
    bounds.low = bounds.low.cwiseMin(ray);
    bounds.high = bounds.high.cwiseMax(ray);
  };
  for (int i = 0; i <= n_steps; ++i) {
    const double s = static_cast<double>(i) / n_steps;
    for (double border : {0.0, 1.0}) {
      include(s, border);
      include(border, s);
    }
  }
  return bounds;
}

Corner corner_between(const Corner& from, const Corner& to, double s) {
  return {from.camera_m + s * (to.camera_m - from.camera_m),
          from.darkness + s * (to.darkness - from.darkness)};
}

bool bends(const Intrinsics& camera) {
  return std::ranges::any_of(camera.distortion, [](double k) { return k != 0; });
}
}  // namespace

Viewpoint::Viewpoint(const Intrinsics& camera) : camera_(camera), lens_bends_(bends(camera)) {
  const RayBounds bounds = ray_bounds(camera);
  limits_[0] = {0, 0, 1, -nearest_m};
  limits_[1] = {1, 0, -bounds.low.x(), 0};
  limits_[2] = {-1, 0, bounds.high.x(), 0};
  limits_[3] = {0, 1, -bounds.low.y(), 0};
  limits_[4] = {0, -1, bounds.high.y(), 0};
  place(default_camera_from_board());
}

void Viewpoint::place(const Pose& camera_from_board) {
  camera_from_board_ = camera_from_board;
  const Eigen::Quaterniond board_from_camera = camera_from_board.orientation.conjugate();
  eye_board_m_ = board_from_camera * Vector3d(-camera_from_board.position_m);
  const Vector3d up = camera_from_board.orientation * Vector3d::UnitZ();
  limits_[table_limit] << up, table_tolerance_m - up.dot(camera_from_board.position_m);
}

double Viewpoint::within(std::size_t limit, const Vector3d& camera_m) const {
  return limits_[limit].head<3>().dot(camera_m) + limits_[limit].w();
}

Corner Viewpoint::seen(const Vector3d& camera_m, double darkness) const {
  Corner corner{camera_m, darkness};
  for (std::size_t limit = 0; limit < n_limits; ++limit)
    if (!(within(limit, camera_m) >= 0)) corner.hidden_by |= 1u << limit;
  if (!corner.hidden_by) corner.pixel = project(camera_, camera_m);
  return corner;
}

Corner Viewpoint::corner(const Vector3d& board_m, double darkness) const {
  return seen(camera_from_board_ * board_m, darkness);
}

std::optional<Vector3d> Viewpoint::point_at_height(const Vector2d& pixel, double height_m) const {
  const Vector2d last(camera_.width_px - 1, camera_.height_px - 1);
  const Vector2d ray = undistort(camera_, pixel.cwiseMax(0.0).cwiseMin(last));
  const Eigen::Quaterniond board_from_camera = camera_from_board_.orientation.conjugate();
  const Vector3d along = board_from_camera * Vector3d(ray.x(), ray.y(), 1);
  const double distance = (height_m - eye_board_m_.z()) / along.z();
  if (!(distance > nearest_m)) return std::nullopt;
  return eye_board_m_ + distance * along;
}

bool Viewpoint::faces_camera(const Vector3d& point_board_m, const Vector3d& normal) const {
  return normal.dot(eye_board_m_ - point_board_m) > 0;
}

int Viewpoint::pieces(const Vector3d& from_board_m, const Vector3d& to_board_m) const {
  if (!lens_bends_) return 1;
  const Corner from = corner(from_board_m), to = corner(to_board_m);
  const Corner middle = corner((from_board_m + to_board_m) / 2);
  if (from.hidden_by || to.hidden_by || middle.hidden_by) return most_pieces;
  const Vector2d along = to.pixel - from.pixel, part = middle.pixel - from.pixel;
  const double length_px = along.norm();
  if (length_px < 1) return 1;
  const double bend_px = std::abs(along.x() * part.y() - along.y() * part.x()) / length_px;
  // The error of n pieces falls as 1 / n^2.
  const double needed = std::ceil(std::sqrt(bend_px / straight_enough_px));
  return std::clamp(static_cast<int>(needed), 1, most_pieces);
}

// Clips at one limit after the other. A polygon that needs no clipping is returned unchanged.
std::span<const Corner> Viewpoint::clip(std::span<const Corner> polygon, CutQuad& cut) const {
  unsigned any = 0, all = ~0u;
  for (const Corner& corner : polygon) {
    any |= corner.hidden_by;
    all &= corner.hidden_by;
  }
  if (all) return {};
  if (!any) return polygon;
  cut = CutQuad(polygon);
  for (std::size_t limit = 0; limit < n_limits; ++limit)
    if (any & 1u << limit)
      cut = clipped(
          cut, [&](const Corner& c) { return within(limit, c.camera_m); }, corner_between);
  for (Corner& corner : cut) corner.pixel = project(camera_, corner.camera_m);
  return {cut.begin(), cut.end()};
}

Pose default_camera_from_board() {
  return camera_above_board(0.45, 55 * M_PI / 180);
}

}  // namespace heft
