// The board's tags do not fit the distances between them.
#include <gtest/gtest.h>

#include "base/math/Quantiles.h"
#include "tracking/Scenes.h"
#include "tracking/Tracker.h"

namespace heft {
namespace {

constexpr std::uint64_t seed = 20261127;
constexpr int n_pictures = 48;

struct Tips {
  std::vector<double> errors_mm;
  double excess = 0;
  double p95_mm() const { return quantile(errors_mm, 0.95).value_or(1e9); }
};

Tips tracked(const SyntheticSettings& settings) {
  const Apparatus apparatus = default_apparatus(640);
  SyntheticCamera camera(apparatus, settings, seed);
  Tracker tracker(apparatus);
  RandomStream random(seed, "grips");
  Tips tips;
  for (int i = 0; i < n_pictures; ++i) {
    const Pose pose = random_held_pose(random);
    tracker.reset();
    const TrackedPicture seen =
        tracker.track(camera.picture([&](double) { return std::optional(pose); }, i,
                                     static_cast<std::uint64_t>(i)),
                      i);
    tips.excess = seen.board_tag_excess;
    const Eigen::Vector3d tip_m(0.045, 0, 0);
    if (seen.board_from_effector && seen.quality > 0.3)
      tips.errors_mm.push_back(1e3 * (*seen.board_from_effector * tip_m - pose * tip_m).norm());
  }
  return tips;
}

// Otherwise their size would be attributed to the tone curve, and the effector would be millimeters
// nearer or farther.
TEST(TagSize, IsLearnedBesideTheToneCurve) {
  for (const double film_curve : {0.0, 1.0})
    for (const double scale : {0.99, 1.01}) {
      SyntheticSettings settings;
      settings.files.board_tag_scale = scale;
      settings.optics.film_curve = film_curve;
      const Tips tips = tracked(settings);
      EXPECT_NEAR(tips.excess, scale - 1, 0.002) << "seed " << seed;
      EXPECT_LT(tips.p95_mm(), 0.8) << "seed " << seed;
      EXPECT_GT(tips.errors_mm.size(), n_pictures / 2) << "seed " << seed;
    }
}

TEST(TagSize, OfTheFileIsKeptUnlessItIsWrong) {
  SyntheticSettings settings;
  EXPECT_EQ(tracked(settings).excess, 0);
  for (auto change : {+[](Optics& to) { to.film_curve = 1; }, +[](Optics& to) { to.gamma = 1.8; },
                      +[](Optics& to) { to.noise = 8; }, +[](Optics& to) { to.shadow = 0.6; },
                      +[](Optics& to) { to.blur_px = 1.2; }, +[](Optics& to) { to.glare = 0.3; },
                      +[](Optics& to) { to.exposure = 1.3; }}) {
    settings.optics = {};
    change(settings.optics);
    EXPECT_EQ(tracked(settings).excess, 0);
  }
}

}  // namespace
}  // namespace heft
