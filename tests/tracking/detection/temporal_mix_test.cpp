// Tracking with cameras that denoise over time, repeat pictures or refocus.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/Random.h"
#include "tracking/Scenes.h"
#include "tracking/Tracker.h"
#include "tracking/detection/TemporalMix.h"

namespace heft {
namespace {

constexpr double rate_hz = 30;

// A step of light with noise that a camera has denoised.
class NoisyStep {
 public:
  NoisyStep(double share, bool spares_motion) : share_(share), spares_motion_(spares_motion) {}

  /// @param edge_px column at which dark changes to bright
  Image next(int edge_px, double gain = 1) {
    Image now(640, 480, 1);
    for (int y = 0; y < now.height; ++y)
      for (int x = 0; x < now.width; ++x)
        now.pixels[static_cast<std::size_t>(y * now.width + x)] = static_cast<std::uint8_t>(
            std::lround(gain * (x < edge_px ? 40 : 200) + 3 * draws_.normal()));
    if (mean_.empty()) mean_.assign(now.pixels.begin(), now.pixels.end());
    for (std::size_t i = 0; i < mean_.size(); ++i) {
      const double change = now.pixels[i] - mean_[i];
      mean_[i] += (spares_motion_ && std::abs(change) > 40 ? 1 : 1 - share_) * change;
      now.pixels[i] = static_cast<std::uint8_t>(std::lround(mean_[i]));
    }
    return now;
  }

 private:
  double share_;
  bool spares_motion_;
  RandomStream draws_{7, "noise"};
  std::vector<double> mean_;
};

double share_after(int n_pictures, double share, double gain_change = 0) {
  NoisyStep camera(share, false);
  TemporalMix mix;
  for (int i = 0; i < n_pictures; ++i)
    mix.cleared(camera.next(160, 1 + gain_change * i / 2), i / rate_hz, 3);
  return mix.share();
}

TEST(TemporalMix, IsRecognizedByNoiseWhereNothingMoves) {
  EXPECT_EQ(share_after(20, 0), 0);
  EXPECT_NEAR(share_after(20, 0.3), 0.3, 0.03);
  EXPECT_NEAR(share_after(30, 0.6), 0.6, 0.06);
  EXPECT_EQ(share_after(8, 0.3), 0);  // the camera's start
}

TEST(TemporalMix, IsNoChangeOfGain) {
  EXPECT_EQ(share_after(20, 0, 0.01), 0);
  EXPECT_NEAR(share_after(20, 0.3, 0.01), 0.3, 0.04);
}

// Mean level between the positions of an edge that moved by 20 pixels: dark before, bright now.
double level_of_ghost(bool spares_motion, double late_s) {
  NoisyStep camera(0.3, spares_motion);
  TemporalMix mix;
  for (int i = 0; i < 20; ++i) mix.cleared(camera.next(160), i / rate_hz, 3);
  const Image clear = mix.cleared(camera.next(140), 20 / rate_hz + late_s, 3);
  double sum = 0;
  for (int y = 0; y < clear.height; ++y)
    for (int x = 142; x < 158; ++x)
      sum += clear.pixels[static_cast<std::size_t>(y * clear.width + x)];
  return sum / (16 * clear.height);
}

TEST(TemporalMix, IsRemovedUnlessTheDenoiserSparesMotion) {
  EXPECT_NEAR(level_of_ghost(false, 0), 200, 4);
  EXPECT_NEAR(level_of_ghost(true, 0), 200, 1);
  EXPECT_NEAR(level_of_ghost(false, 1 / rate_hz), 152, 2);  // after a lost picture it is left
}

struct Tracked {
  std::vector<TrackedPicture> pictures;
  std::vector<double> tip_mm, board_mm;
};

// Grips that move, 8 pictures each. Tips of the first grip, and of the first three pictures of
// each, are not counted.
Tracked track(const Optics& optics, int n_grips, double speed_m_s) {
  const Apparatus apparatus = default_apparatus(640);
  SyntheticSettings settings;
  settings.optics = optics;
  SyntheticCamera camera(apparatus, settings, 3);
  Tracker tracker(apparatus);
  RandomStream grips(4, "grips");
  Tracked all;
  for (int grip = 0; grip < n_grips; ++grip) {
    const Pose held = random_held_pose(grips);
    for (int i = 0; i < 8; ++i) {
      const double t_s = (8 * grip + i) / rate_hz, middle_s = (8 * grip + 4) / rate_hz;
      const auto path = [&](double at_s) {
        return std::optional<Pose>(
            {held.position_m + Eigen::Vector3d(speed_m_s * (at_s - middle_s), 0, 0),
             held.orientation});
      };
      const auto number = static_cast<std::uint64_t>(8 * grip + i);
      const TrackedPicture seen = tracker.track(camera.picture(path, t_s, number), t_s);
      all.pictures.push_back(seen);
      const Eigen::Vector3d tip_m(0.045, 0, 0);
      if (seen.board_from_effector && grip > 0 && i >= 3)
        all.tip_mm.push_back(
            1e3 * (*seen.board_from_effector * tip_m - *path(seen.effector_t_s) * tip_m).norm());
      if (seen.camera_from_board)
        all.board_mm.push_back(
            1e3 *
            (seen.camera_from_board->position_m - settings.camera_from_board.position_m).norm());
    }
  }
  return all;
}

double worst_of_most(std::vector<double> errors) {
  std::ranges::sort(errors);
  return errors.at(errors.size() * 9 / 10);
}

TEST(TrackedDenoising, LeavesTheTipWhereItIs) {
  const Tracked all = track({.last_picture = 0.3}, 6, 0.25);
  EXPECT_EQ(all.tip_mm.size(), track({}, 6, 0.25).tip_mm.size());
  EXPECT_LT(worst_of_most(all.tip_mm), 1);
  EXPECT_NEAR(all.pictures.back().last_picture, 0.3, 0.04);
  EXPECT_NEAR(all.pictures.back().noise, 3, 0.5);
}

TEST(TrackedRepeats, ArePosesOfTheirOwnTime) {
  const Tracked all = track({.repeated = 0.4}, 3, 0.25);
  EXPECT_GT(std::ranges::count_if(all.pictures, &TrackedPicture::repeated), 4);
  EXPECT_LT(worst_of_most(all.tip_mm), 1);
}

TEST(TrackedBreathing, IsFollowedByTheBoardsPerspective) {
  const Tracked breathing = track({.breathing = 0.004}, 12, 0);
  EXPECT_LT(worst_of_most(breathing.board_mm), 0.5);
  double largest = 0;
  for (const TrackedPicture& seen : breathing.pictures)
    largest = std::max(largest, seen.focal_length_scale - 1);
  EXPECT_NEAR(largest, 0.004, 0.001);
  for (const TrackedPicture& seen : track({}, 4, 0).pictures)
    EXPECT_NEAR(seen.focal_length_scale, 1, 3e-4);
}

}  // namespace
}  // namespace heft
