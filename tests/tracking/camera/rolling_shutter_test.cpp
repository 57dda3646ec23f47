// Rolling shutters: the shear of moving objects in pictures, and its correction.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/Pose.h"
#include "tracking/Scenes.h"
#include "tracking/Tracker.h"
#include "tracking/pose/RollingShutter.h"

namespace heft {
namespace {

constexpr double rolling_s = 0.025;

Intrinsics rolling_camera() {
  Intrinsics camera = default_camera(640, 480);
  camera.readout_s = rolling_s;
  return camera;
}

// The moving effector in the camera's frame.
struct Moving {
  Pose start;
  Velocity velocity;

  Pose at(double t_s) const {
    return {start.position_m + t_s * velocity.linear_m_s,
            rotation_from_vector(t_s * velocity.angular_rad_s) * start.orientation};
  }
  Eigen::Vector2d seen(const Intrinsics& camera, const Eigen::Vector3d& point_m) const {
    Eigen::Vector2d pixel(0, 0);
    for (int i = 0; i < 20; ++i)
      pixel = project(camera, at(camera.readout_s * pixel.y() / camera.height_px) * point_m);
    return pixel;
  }
};

std::vector<TagObservation> observations(const Intrinsics& camera, const MarkerBody& body,
                                         const Moving& moving) {
  std::vector<TagObservation> tags;
  for (const Tag& tag : body.tags) {
    const auto& c = tag.corners_m;
    MeasuredTag seen = unrefined_tag({moving.seen(camera, c[0]), moving.seen(camera, c[1]),
                                      moving.seen(camera, c[2]), moving.seen(camera, c[3])});
    for (std::size_t i = 0; i < 4; ++i) {
      seen.edges[i].points_px = {seen.corners_px[i],
                                 moving.seen(camera, (c[i] + c[(i + 1) % 4]) / 2)};
      seen.edges[i].sd_px = 0.02;
    }
    tags.push_back(observe(camera, tag, seen, true));
  }
  return tags;
}

TEST(RollingShutter, RowsAreTakenBackToTheBodysOwn) {
  const Intrinsics camera = rolling_camera();
  MarkerBody effector = box_effector(0.032);
  effector.tags = {effector.tags[1], effector.tags[2]};  // top and left are in view
  const Pose held = upright_pose({0.02, -0.01, 0.05}, M_PI / 2);
  const Pose from_board = SyntheticSettings().camera_from_board;
  const Moving moving{
      {from_board * held.position_m, from_board.orientation * held.orientation *
                                         Eigen::AngleAxisd(0.6, Eigen::Vector3d::UnitX())},
      {{0.4, -0.2, 0.1}, {0.5, -1, 2}}};
  const auto tags = observations(camera, effector, moving);
  auto fit = solve_body(tags, moving.start, {0, 0});
  ASSERT_TRUE(fit);
  const auto off_m = [&] {
    const Pose truth = moving.at(own_row_s(camera, fit->camera_from_body));
    const Eigen::Vector3d tip_m(0.045, 0, 0);
    return (fit->camera_from_body * tip_m - truth * tip_m).norm();
  };
  EXPECT_GT(off_m(), 0.0003);
  for (int i = 0; i < 3; ++i)
    fit = solve_body(held_still(tags, camera, fit->camera_from_body, moving.velocity),
                     fit->camera_from_body, {0, 0});
  EXPECT_LT(off_m(), 0.00002);
}

TEST(RollingShutter, WhatStandsStillIsFilmedAsByAnyOther) {
  const Apparatus apparatus = default_apparatus(640);
  SyntheticSettings settings;
  const auto still = [](double) -> std::optional<Pose> { return upright_pose({0, 0, 0.05}, 1.2); };
  const Image global = SyntheticCamera(apparatus, settings, 1).picture(still, 0, 0);
  settings.optics.readout_s = rolling_s;
  EXPECT_EQ(SyntheticCamera(apparatus, settings, 1).picture(still, 0, 0).pixels, global.pixels);
}

struct Found {
  double worst_m = 0, worst_row_s = 0;
  double best_early_quality = 0;  ///< of the first two pictures
  int n = 0;
};

// Steady motion at 0.4 m/s; from the third picture on, the velocity is known.
// @param n_lost pictures that are missing before the fifth and in the times
Found tracked(bool told, int n_lost = 0) {
  Apparatus apparatus = default_apparatus(640);
  apparatus.camera.readout_s = told ? rolling_s : 0;
  SyntheticSettings settings;
  settings.optics.readout_s = rolling_s;
  settings.hand = false;
  SyntheticCamera camera(apparatus, settings, 1);
  Tracker tracker(apparatus);
  Found found;
  for (int direction = 0; direction < 5; ++direction) {
    tracker.reset();
    const double angle = 1.3 * direction;
    Pose middle = upright_pose({0, -0.01, 0.05}, M_PI / 2);
    middle.orientation = middle.orientation * Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitX());
    const auto path = [&](double t_s) -> std::optional<Pose> {
      Pose pose = middle;
      pose.position_m += 0.4 * (t_s - 0.08) * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0);
      return pose;
    };
    for (int i = 0; i < 6; ++i) {
      const double late_s = i < 4 ? 0 : n_lost / 30.0, t_s = i / 30.0 + late_s;
      const auto seen =
          tracker.track(camera.picture(path, t_s, static_cast<std::uint64_t>(i)), t_s - late_s);
      if (i < 2) found.best_early_quality = std::max(found.best_early_quality, seen.quality);
      if (i < 2 || !seen.board_from_effector) continue;
      const Pose at_row = settings.camera_from_board * *path(t_s + 0.012);
      const double row_s = rolling_s * project(apparatus.camera, at_row.position_m).y() / 480;
      const Eigen::Vector3d tip_m(0.045, 0, 0), truth_m = *path(t_s + row_s) * tip_m;
      found.worst_m = std::max(found.worst_m, (*seen.board_from_effector * tip_m - truth_m).norm());
      found.worst_row_s =
          std::max(found.worst_row_s, std::abs(seen.effector_t_s + late_s - t_s - row_s));
      ++found.n;
    }
  }
  return found;
}

TEST(RollingShutter, ATrackerThatKnowsItFollowsMotion) {
  const Found told = tracked(true), untold = tracked(false);
  EXPECT_GE(told.n, 18);
  EXPECT_LT(told.best_early_quality, 0.3);  // without a velocity, centimeters may be wrong
  EXPECT_LT(told.worst_m, 0.00022);         // .00025 with a trend from the first pose of all
  EXPECT_LT(told.worst_row_s, 0.0003);
  EXPECT_GT(untold.worst_m, 0.003);
}

// Files without times do not show lost pictures; the shear of the rows does.
TEST(RollingShutter, ItsShearShowsLostPictures) {
  for (const int n_lost : {1, 2}) {
    const Found found = tracked(true, n_lost);
    EXPECT_GE(found.n, 18);
    EXPECT_LT(found.worst_m, 0.0006) << n_lost;
  }
}

}  // namespace
}  // namespace heft
