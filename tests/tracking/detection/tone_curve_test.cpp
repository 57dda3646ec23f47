// Cameras whose tone curve is not sRGB: the curve itself, and how it is learned from the board.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tracking/Scenes.h"
#include "tracking/Tracker.h"
#include "tracking/detection/ToneCurve.h"
#include "tracking/synthetic/RayCaster.h"

namespace heft {
namespace {

TEST(ToneCurve, WithoutABendIsSrgb) {
  const ToneCurve curve;
  for (const double light : {-0.1, 0.0, 0.002, 0.03, 0.4, 1.0, 1.3})
    EXPECT_EQ(curve.stored(light).value, stored_of_light(light).value);
  EXPECT_EQ(curve.light(100), light_of_stored(100));
}

TEST(ToneCurve, ABentOneIsItsInversesInverseAndRises) {
  const ToneCurve curve(ToneBend(0.4, 0.9, -0.5));
  double before = -1;
  for (double value = 2; value < 254; value += 7) {
    const double light = curve.light(value);
    EXPECT_GT(light, before);
    EXPECT_NEAR(curve.stored(light).value, value, 0.2);
    before = light;
  }
}

TEST(ToneCurve, KnowsHowItMovesWithItsBend) {
  const ToneBend bend(0.2, 0.3, 0.1);
  const ToneCurve curve(bend);
  constexpr double small = 1e-3;
  for (const double light : {0.05, 0.3, 0.8})
    for (int k = 0; k < 3; ++k) {
      const ToneCurve more(bend + small * ToneBend::Unit(k));
      const double by_difference = (more.stored(light).value - curve.stored(light).value) / small;
      EXPECT_NEAR(curve.stored_by_bend(curve.stored(light).value)(k), by_difference,
                  0.02 * std::abs(by_difference) + 0.3);
    }
}

// The tip's errors from the borders of its tags, largest last, over a few grips.
std::vector<double> tip_errors_mm(const CameraFaults& faults, bool learns) {
  const Apparatus apparatus = default_apparatus(640);
  const Pose camera_from_board = camera_above_board(0.45, 52 * M_PI / 180);
  const RayCaster caster(apparatus, camera_from_board, 4);
  TrackerSettings settings;
  settings.remove_bias = learns;
  settings.inner_edges = false;
  Tracker tracker(apparatus, settings);
  const Eigen::Vector3d tip_m(0.045, 0, 0);
  std::vector<double> errors_mm;
  for (int i = 0; i < 3; ++i) {
    const Pose pose{{0.03 * (i - 1), -0.02, 0.045},
                    Eigen::AngleAxisd(M_PI / 2 + 0.3 * (i - 1), Eigen::Vector3d::UnitZ()) *
                        Eigen::AngleAxisd(0.5 - 0.4 * i, Eigen::Vector3d::UnitX())};
    const Image image =
        caster.picture([&](double) { return pose; }, 0, faults, static_cast<std::uint64_t>(i));
    tracker.reset();
    const TrackedPicture seen = tracker.track(image, i);
    errors_mm.push_back(seen.board_from_effector
                            ? 1e3 * (*seen.board_from_effector * tip_m - pose * tip_m).norm()
                            : 100);
  }
  std::ranges::sort(errors_mm);
  return errors_mm;
}

TEST(ToneLearning, AShoulderInTheCurveNoLongerMovesTheTip) {
  CameraFaults film;
  film.tone = film_curve;
  EXPECT_LT(tip_errors_mm(film, true).back(), 1.1);
  EXPECT_GT(tip_errors_mm(film, false).back(), 2);
}

TEST(ToneLearning, FindsNothingWhereNothingIsBent) {
  EXPECT_LT(tip_errors_mm({}, true).back(), 0.4);
}

// An error of a hundredth of a pixel that is equal in all pictures does not average out.
TEST(ToneLearning, ManyPicturesOfAnSrgbCameraBendNothing) {
  const Apparatus apparatus = default_apparatus(640);
  SyntheticCamera camera(apparatus, {}, 7);
  TrackerSettings settings;
  settings.inner_edges = false;
  Tracker learns(apparatus, settings);
  settings.remove_bias = false;
  Tracker takes_srgb(apparatus, settings);
  const Pose grip{{0.02, -0.02, 0.045},
                  Eigen::AngleAxisd(1.4, Eigen::Vector3d::UnitZ()) *
                      Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitX())};
  double sum_mm = 0;
  constexpr int n = 40, learning = 10;
  for (int i = 0; i < n; ++i) {
    const Image image =
        camera.picture([&](double) { return grip; }, i / 30.0, static_cast<std::uint64_t>(i));
    const auto with = learns.track(image, i / 30.0).board_from_effector;
    const auto without = takes_srgb.track(image, i / 30.0).board_from_effector;
    ASSERT_TRUE(with && without);
    if (i >= learning) sum_mm += 1e3 * (with->position_m - without->position_m).norm();
  }
  EXPECT_LT(sum_mm / (n - learning), 0.02);
}

}  // namespace
}  // namespace heft
