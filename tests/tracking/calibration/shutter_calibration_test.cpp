#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/Error.h"
#include "base/Random.h"
#include "tracking/Scenes.h"
#include "tracking/calibration/ShutterCalibration.h"

namespace heft {
namespace {

// A board that is waved to and fro, up and down, and turned.
Pose waved(double t_s, double vigor) {
  const Pose still = camera_above_board(0.45, 52 * M_PI / 180);
  const Eigen::Vector3d way(0.03 * std::sin(9 * t_s), 0.025 * std::sin(7 * t_s + 1),
                            0.02 * std::sin(5 * t_s));
  const Eigen::Quaterniond turn(
      Eigen::AngleAxisd(0.1 * vigor * std::sin(6 * t_s), Eigen::Vector3d::UnitZ()));
  return still * Pose{vigor * way, turn};
}

// What each row sees when it is read; corners are some hundredths of a pixel off.
// @param moment when picture i is taken
template <typename Moment>
std::vector<TimedView> filmed(double readout_s, double vigor, int n, const Moment& moment) {
  const Apparatus apparatus = default_apparatus(640);
  RandomStream random(5, "corners");
  std::vector<TimedView> views;
  for (int i = 0; i < n; ++i) {
    TimedView seen{i / 30.0, {}};
    const double moment_s = moment(i);
    for (std::size_t tag = 0; tag < apparatus.board.tags.size(); ++tag) {
      SeenTag corners{tag, {}};
      for (std::size_t c = 0; c < 4; ++c) {
        const Eigen::Vector3d& corner_m = apparatus.board.tags[tag].corners_m[c];
        Eigen::Vector2d pixel(0, 240);
        for (int round = 0; round < 5; ++round) {
          const double late_s = readout_s * pixel.y() / apparatus.camera.height_px;
          pixel = project(apparatus.camera, waved(moment_s + late_s, vigor) * corner_m);
        }
        corners.corners_px[c] = pixel + 0.05 * Eigen::Vector2d(random.normal(), random.normal());
      }
      seen.view.tags.push_back(corners);
    }
    views.push_back(seen);
  }
  return views;
}

ShutterCalibration found(double readout_s, double vigor = 1, int n = 60) {
  const Apparatus apparatus = default_apparatus(640);
  return calibrate_shutter(apparatus.board, apparatus.camera,
                           filmed(readout_s, vigor, n, [](int i) { return i / 30.0; }));
}

TEST(ShutterCalibration, FindsTheReadoutWithinAMillisecond) {
  for (const double readout_s : {0.0, 0.008, 0.025, 0.033}) {
    const ShutterCalibration calibration = found(readout_s);
    EXPECT_NEAR(calibration.readout_s, readout_s, 0.001);
    EXPECT_TRUE(doubts(calibration).empty()) << summary(calibration);
    EXPECT_THAT(summary(calibration), testing::HasSubstr("verdict: good"));
  }
}

TEST(ShutterCalibration, DoubtsABoardThatHardlyMoves) {
  const ShutterCalibration calibration = found(0.025, 0.01);
  EXPECT_FALSE(doubts(calibration).empty());
  EXPECT_THAT(summary(calibration), testing::HasSubstr("verdict: doubtful"));
}

// Views for a calibration of the lens, in any order: no row is late, and nothing moved.
TEST(ShutterCalibration, DoubtsStillViews) {
  RandomStream random(7, "still views");
  const Apparatus apparatus = default_apparatus(640);
  const ShutterCalibration calibration =
      calibrate_shutter(apparatus.board, apparatus.camera,
                        filmed(0, 2, 44, [&](int) { return 100 * random.uniform(); }));
  EXPECT_THAT(doubts(calibration), testing::Contains(testing::HasSubstr("still views")));
  EXPECT_LT(found(0.025).unsteadiness, 0.3);
}

TEST(ShutterCalibration, RefusesPicturesWithoutNeighbors) {
  EXPECT_THROW(found(0.025, 1, 2), Error);
}

TEST(ShutterCalibration, ShowsTheSpeedOfHalfAMillimeter) {
  EXPECT_NEAR(half_millimeter_m_s(0.025), 0.2, 1e-9);
}

}  // namespace
}  // namespace heft
