// What a person with a board in front of a camera produces: views from all around it.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "Scenes.h"

namespace heft {

/// A camera that looks at a point of the board from all sides, so that the board fills another part
/// of the picture each time. @param spread 0: always from the same side
inline Pose view_of_board(RandomStream& random, double spread) {
  const auto within = [&](double half) { return half * (2 * random.uniform() - 1); };
  const double around = within(M_PI) * spread, tilt = 0.15 + 0.65 * random.uniform() * spread;
  const double distance_m = 0.36 + 0.14 * random.uniform();
  const Eigen::Vector3d seen_m(within(0.10), within(0.08), 0);
  const Eigen::Vector3d back(std::sin(tilt) * std::cos(around), std::sin(tilt) * std::sin(around),
                             std::cos(tilt));
  const Eigen::Vector3d z = -back;
  const double roll = within(0.5);
  const Eigen::Vector3d hint(std::cos(roll), std::sin(roll), 0);
  const Eigen::Vector3d y = z.cross(hint).normalized(), x = y.cross(z);
  Eigen::Matrix3d camera_from_board;
  camera_from_board << x.transpose(), y.transpose(), z.transpose();
  const Eigen::Vector3d eye_m = seen_m + distance_m * back;
  return {-(camera_from_board * eye_m), Eigen::Quaterniond(camera_from_board)};
}

struct Pictures {
  std::vector<Image> images;
  std::vector<std::string> names;
};

inline Pictures board_pictures(const Apparatus& apparatus, int n, double spread,
                               std::uint64_t seed) {
  Pictures pictures;
  RandomStream random(seed, "views of the board");
  for (int i = 0; i < n; ++i) {
    SyntheticSettings settings;
    settings.camera_from_board = view_of_board(random, spread);
    settings.hand = false;
    SyntheticCamera camera({apparatus.camera, apparatus.board, {}}, settings, seed);
    const auto nothing = [](double) -> std::optional<Pose> { return std::nullopt; };
    pictures.images.push_back(camera.picture(nothing, 0, static_cast<std::uint64_t>(i)));
    pictures.names.push_back("view " + std::to_string(i));
  }
  return pictures;
}

/// An effector made by hand: each tag slipped and turned on its face, by 1.8 mm a corner on
/// average.
inline MarkerBody handmade(const MarkerBody& nominal, std::uint64_t seed) {
  MarkerBody made = nominal;
  RandomStream random(seed, "slips");
  for (Tag& tag : made.tags) {
    const Eigen::Vector3d normal = tag_normal(tag), center_m = tag_center_m(tag);
    const double direction = 2 * M_PI * random.uniform();
    const Eigen::Vector3d across = (tag.corners_m[1] - tag.corners_m[0]).normalized();
    const Eigen::Vector3d slip_m = 0.0018 * (Eigen::AngleAxisd(direction, normal) * across);
    const Eigen::AngleAxisd turn(0.03 * (2 * random.uniform() - 1), normal);
    for (Eigen::Vector3d& corner_m : tag.corners_m)
      corner_m = center_m + slip_m + turn * (corner_m - center_m);
  }
  return made;
}

/// The effector turned this way and that above the board, its tip or a side towards the camera.
inline std::vector<Image> effector_pictures(const Apparatus& apparatus, int n, std::uint64_t seed) {
  SyntheticSettings settings;
  settings.hand = false;
  SyntheticCamera camera(apparatus, settings, seed);
  RandomStream random(seed, "turns of the effector");
  const auto within = [&](double half) { return half * (2 * random.uniform() - 1); };
  std::vector<Image> pictures;
  for (int i = 0; i < n; ++i) {
    const Pose held{{within(0.06), within(0.04), 0.10 + within(0.03)},
                    Eigen::AngleAxisd(within(M_PI), Eigen::Vector3d::UnitZ()) *
                        Eigen::AngleAxisd(-0.7 + within(0.6), Eigen::Vector3d::UnitY()) *
                        Eigen::AngleAxisd(within(M_PI), Eigen::Vector3d::UnitX())};
    const auto still = [&](double) -> std::optional<Pose> { return held; };
    pictures.push_back(camera.picture(still, 0, static_cast<std::uint64_t>(i)));
  }
  return pictures;
}

/// Mean distance of corners once one set of tags is brought onto the other as a whole.
inline double placement_error_m(const std::vector<Tag>& found, const std::vector<Tag>& truth) {
  const auto n = static_cast<Eigen::Index>(4 * found.size());
  Eigen::Matrix3Xd from(3, n), to(3, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto tag = static_cast<std::size_t>(i / 4), corner = static_cast<std::size_t>(i % 4);
    from.col(i) = found[tag].corners_m[corner];
    to.col(i) = truth[tag].corners_m[corner];
  }
  const Eigen::Isometry3d rigid(Eigen::umeyama(from, to, false));
  return ((rigid * from) - to).colwise().norm().mean();
}

/// p95 and median over the picture of how far a ray of one camera is from the same pixel's of the
/// other, in pixels.
inline std::pair<double, double> ray_errors_px(const Intrinsics& found, const Intrinsics& truth) {
  std::vector<double> errors;
  for (int y = 0; y < truth.height_px; y += 8)
    for (int x = 0; x < truth.width_px; x += 8) {
      const Eigen::Vector2d pixel(x, y);
      errors.push_back((undistort(found, pixel) - undistort(truth, pixel)).norm() * truth.fx_px);
    }
  std::ranges::sort(errors);
  return {errors[errors.size() * 95 / 100], errors[errors.size() / 2]};
}

}  // namespace heft
