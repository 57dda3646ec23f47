// Pictures as of a person who holds a hand-made effector before a camera.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "tracking/Scenes.h"
#include "tracking/synthetic/BoardViews.h"

namespace heft {

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

/// The effector turned in various ways above the board, its tip or a side towards the camera.
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

/// Mean distance of corners after one set of tags was fitted to the other as a whole.
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

}  // namespace heft
