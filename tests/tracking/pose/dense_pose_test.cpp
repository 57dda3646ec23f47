// Poses by the inner edges of tags, on pictures of the synthetic camera.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tracking/Scenes.h"
#include "tracking/Tracker.h"
#include "tracking/pose/DensePose.h"
#include "tracking/synthetic/RayCaster.h"

namespace heft {
namespace {

Pose held(double x_m, double yaw_rad, double pitch_rad, double roll_rad) {
  return {{x_m, -0.025, 0.04},
          Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()) *
              Eigen::AngleAxisd(pitch_rad, Eigen::Vector3d::UnitY()) *
              Eigen::AngleAxisd(roll_rad, Eigen::Vector3d::UnitX())};
}

// Two faces, one, and one that is slanted in both directions, so that the blur on the tag is
// slanted.
const std::vector<Pose> grips{held(0.02, 1.4, 0.1, 0.5), held(-0.03, 1.9, 0, -0.1),
                              held(-0.02, 1.4, 0.05, -0.45), held(0.03, 1.3, 0.2, 0.2)};

struct TipErrors {
  double rms_mm = 0, worst_mm = 0;
};

TipErrors tip_errors(const CameraFaults& faults, bool inner_edges) {
  const Apparatus apparatus = default_apparatus(640);
  const RayCaster caster(apparatus, camera_above_board(0.45, 52 * M_PI / 180), 4);
  TrackerSettings settings;
  settings.inner_edges = inner_edges;
  Tracker tracker(apparatus, settings);
  const Eigen::Vector3d tip_m(0.045, 0, 0);
  TipErrors errors;
  for (std::size_t i = 0; i < grips.size(); ++i) {
    tracker.reset();
    const Image image = caster.picture([&](double) { return grips[i]; }, 0, faults, i);
    const TrackedPicture seen = tracker.track(image, static_cast<double>(i));
    EXPECT_TRUE(seen.board_from_effector) << i;
    if (!seen.board_from_effector) continue;
    const double off_mm = 1e3 * (*seen.board_from_effector * tip_m - grips[i] * tip_m).norm();
    errors.rms_mm += off_mm * off_mm;
    errors.worst_mm = std::max(errors.worst_mm, off_mm);
  }
  errors.rms_mm = std::sqrt(errors.rms_mm / static_cast<double>(grips.size()));
  return errors;
}

TEST(DensePose, InnerEdgesHalveTheErrorOfNoise) {
  CameraFaults noisy;
  noisy.noise = 8;
  const TipErrors inner = tip_errors(noisy, true), borders = tip_errors(noisy, false);
  EXPECT_LT(inner.rms_mm, 0.7 * borders.rms_mm);
  EXPECT_LT(inner.worst_mm, 0.8);
}

// Edges along the pixels' rows may look sharper than a pixel is wide.
TEST(DensePose, APictureWithoutBlurIsNoTrouble) {
  CameraFaults sharp;
  sharp.blur_px = sharp.noise = 0;
  EXPECT_LT(tip_errors(sharp, true).worst_mm, 0.5);
}

TEST(DensePose, ATagAtASlantIsWhereItIs) {
  EXPECT_LT(tip_errors({}, true).worst_mm, 0.3);
}

// The hand covers the lower part of the side face.
TEST(DensePose, ATagUnderFingersCountsWithWhatIsClear) {
  const Apparatus apparatus = default_apparatus(640);
  SyntheticCamera camera(apparatus, {}, 6);
  Tracker tracker(apparatus);
  const Eigen::Vector3d tip_m(0.045, 0, 0);
  const std::vector<Pose> covered{
      {{-0.026, 0.010, 0.040}, held(0, 1.716, 0.061, -0.906).orientation},
      {{-0.042, -0.024, 0.044}, held(0, 1.826, 0.154, -0.938).orientation},
      {{0.034, 0.005, 0.047}, held(0, 1.582, 0.098, -0.949).orientation}};
  double sum_mm2 = 0;
  for (std::size_t i = 0; i < covered.size(); ++i) {
    tracker.reset();
    const auto seen = tracker.track(camera.picture([&](double) { return covered[i]; }, 0, i), 0);
    ASSERT_TRUE(seen.board_from_effector) << i;
    EXPECT_EQ(seen.n_effector_faces, 2) << i;
    sum_mm2 += 1e6 * (*seen.board_from_effector * tip_m - covered[i] * tip_m).squaredNorm();
  }
  EXPECT_LT(std::sqrt(sum_mm2 / static_cast<double>(covered.size())), 0.14);
}

// The reflection clips white and is brightest in its middle. Without a model of it, tags seemed
// larger and up to 2 mm nearer.
TEST(DensePose, ALampsReflectionMovesNoTag) {
  const Apparatus apparatus = default_apparatus(640);
  for (const double exposure : {0.7, 1.0}) {
    SyntheticSettings settings;
    settings.optics.glare = 0.4;
    settings.optics.exposure = exposure;
    SyntheticCamera camera(apparatus, settings, 7);
    Tracker tracker(apparatus);
    const Eigen::Vector3d tip_m(0.045, 0, 0);
    double sum_mm2 = 0;
    for (std::size_t i = 0; i < grips.size(); ++i) {
      tracker.reset();
      const auto seen = tracker.track(camera.picture([&](double) { return grips[i]; }, 0, i),
                                      static_cast<double>(i));
      ASSERT_TRUE(seen.board_from_effector) << i;
      sum_mm2 += 1e6 * (*seen.board_from_effector * tip_m - grips[i] * tip_m).squaredNorm();
    }
    EXPECT_LT(std::sqrt(sum_mm2 / static_cast<double>(grips.size())), 0.35) << exposure;
  }
}

// RMS error of the tip over random grips.
double gripped_rms_mm(const SyntheticSettings& settings, int picture_width_px) {
  const Apparatus apparatus = default_apparatus(picture_width_px);
  SyntheticCamera camera(apparatus, settings, 11);
  Tracker tracker(apparatus);
  const Eigen::Vector3d tip_m(0.045, 0, 0);
  RandomStream random(11, "grips");
  double sum_mm2 = 0;
  constexpr int n_grips = 24;
  int n = 0;
  for (std::uint64_t i = 0; i < n_grips; ++i) {
    const auto within = [&](double half) { return half * (2 * random.uniform() - 1); };
    const Pose grip = held(within(0.05), M_PI / 2 + within(0.7), 0.1 + within(0.15), within(0.6));
    tracker.reset();
    const auto seen = tracker.track(camera.picture([&](double) { return grip; }, 0, i), 0);
    if (!seen.board_from_effector) continue;
    ++n;
    sum_mm2 += 1e6 * (*seen.board_from_effector * tip_m - grip * tip_m).squaredNorm();
  }
  EXPECT_GT(n, n_grips * 9 / 10);
  return std::sqrt(sum_mm2 / n);
}

// Pixels in a shadow over a part of a tag must not displace the pose.
TEST(DensePose, AShadowsEdgeOverATagPullsNoPose) {
  SyntheticSettings settings;
  settings.optics.shadow = 0.4;
  EXPECT_LT(gripped_rms_mm(settings, 640), 0.25);  // .44 where they pull
}

// All edges of the board are displaced; this must not be taken for reflected light.
TEST(DensePose, TagsPrintedTooLargeAreNoUnevenLight) {
  SyntheticSettings settings;
  settings.files.board_tag_scale = 1.01;
  EXPECT_LT(gripped_rms_mm(settings, 1280), 1.5);
}

// RMS error in the third picture of the effector that moves in each direction over the table, 2
// pixels during the exposure.
double smeared_rms_mm(bool inner_edges) {
  const Apparatus apparatus = default_apparatus(640);
  SyntheticCamera camera(apparatus, {}, 5);
  TrackerSettings settings;
  settings.inner_edges = inner_edges;
  Tracker tracker(apparatus, settings);
  const Eigen::Vector3d tip_m(0.045, 0, 0);
  constexpr int n_directions = 12;
  constexpr double speed_m_s = 0.4, between_s = 1.0 / 30;
  double sum_mm2 = 0;
  for (int i = 0; i < n_directions; ++i) {
    const double yaw = 2 * M_PI * i / n_directions;
    const Pose& start = grips[static_cast<std::size_t>(i) % grips.size()];
    const auto path = [&](double t_s) {
      Pose pose = start;
      pose.position_m +=
          speed_m_s * (t_s - between_s) * Eigen::Vector3d(std::cos(yaw), std::sin(yaw), 0);
      return pose;
    };
    tracker.reset();
    TrackedPicture seen;
    for (int picture = 0; picture < 3; ++picture) {
      const double t_s = picture * between_s;
      seen = tracker.track(camera.picture(path, t_s, static_cast<std::uint64_t>(3 * i + picture)),
                           t_s);
    }
    EXPECT_TRUE(seen.board_from_effector) << i;
    if (!seen.board_from_effector) continue;
    const Pose truth = path(2 * between_s);
    sum_mm2 += 1e6 * (*seen.board_from_effector * tip_m - truth * tip_m).squaredNorm();
  }
  return std::sqrt(sum_mm2 / n_directions);
}

TEST(DensePose, KnowsThatMotionSmearsCellsAlongItsWay) {
  EXPECT_LT(smeared_rms_mm(true), 0.75 * smeared_rms_mm(false));
}

}  // namespace
}  // namespace heft
