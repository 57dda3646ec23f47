// The bound of the tip's error against the closed form of a blurred edge.
#include "results/tracking/limits/Bound.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "results/tracking/Filming.h"
#include "tracking/detection/TagEdges.h"

namespace heft {
namespace {

// The camera is straight above, so that only the upper face is visible; light is stored linearly.
SyntheticSettings from_above() {
  SyntheticSettings settings;
  settings.camera_from_board = {{0, 0, 0.4}, Eigen::Quaterniond(0, 1, 0, 0)};
  settings.hand = false;
  settings.optics = {.gamma = 1, .vignetting = 0};
  return settings;
}

Apparatus with_upper_tag() {
  Apparatus apparatus = bench_apparatus(640, EffectorPrint{.only_top = true});
  apparatus.camera.distortion = {};
  return apparatus;
}

// Total length of vertical and horizontal edges between cells, in cells.
int edges_of(const TagPattern& pattern) {
  int n = 0;
  for (int row = 0; row < pattern.n_cells; ++row)
    for (int column = 1; column < pattern.n_cells; ++column) {
      n += pattern.is_white(column, row) != pattern.is_white(column - 1, row);
      n += pattern.is_white(row, column) != pattern.is_white(row, column - 1);
    }
  return n;
}

// Edges end in corners, which have slightly less information. An edge of contrast c, with a normal
// blur of s and noise of v, has the information c^2 / (2 sqrt(pi) s v) on a shift across it, for
// each pixel of its length.
TEST(TipBound, AShiftIsBoundedByTheLengthOfAllEdges) {
  const Apparatus apparatus = with_upper_tag();
  const SyntheticSettings settings = from_above();
  const Pose flat{{0.013, 0.007, 0.02}, Eigen::Quaterniond::Identity()};
  const auto told = TipBound(apparatus, settings).information(flat);

  SyntheticSettings noiseless = settings;
  noiseless.optics.noise = 0;
  const Image image =
      SyntheticCamera(apparatus, noiseless, 1).picture([&](double) { return flat; }, 0, 0);
  const auto gray = [&](int x, int y) {
    const auto* bgr = &image.pixels[static_cast<std::size_t>(3 * (y * image.width + x))];
    return 0.114 * bgr[0] + 0.587 * bgr[1] + 0.299 * bgr[2];
  };
  const Tag& tag = apparatus.effector.tags.front();
  const Pose pose = settings.camera_from_board * flat;
  const auto pixel = [&](std::size_t corner) {
    return project(apparatus.camera, pose * tag.corners_m[corner]);
  };
  const TagPattern pattern = patterns_of(apparatus.effector).front();
  const Eigen::Vector2d middle = (pixel(0) + pixel(2)) / 2;
  const double side_px = (pixel(1) - pixel(0)).norm();
  double dark = 255, bright = 0;
  for (int y = -15; y < 15; ++y)
    for (int x = -15; x < 15; ++x) {
      const double level = gray(static_cast<int>(middle.x()) + x, static_cast<int>(middle.y()) + y);
      dark = std::min(dark, level);
      bright = std::max(bright, level);
    }
  const double contrast = bright - dark, blur_px = std::sqrt(0.36 + 1.0 / 12);
  const double variance = 9 + 1.0 / 12;
  const double px_per_m = side_px / (tag.corners_m[1] - tag.corners_m[0]).norm();
  const double expected = edges_of(pattern) * side_px / pattern.border_cells * contrast * contrast /
                          (2 * std::sqrt(M_PI) * blur_px * variance) * px_per_m * px_per_m;
  EXPECT_NEAR((told(3, 3) + told(4, 4)) / expected, 1, 0.1);
}

TEST(TipBound, GrowsWithTheNoise) {
  const Apparatus apparatus = with_upper_tag();
  SyntheticSettings settings = from_above();
  const Pose pose{{0.013, 0.007, 0.02}, Eigen::Quaterniond::Identity()};
  const auto at_3 = TipBound(apparatus, settings).tip_variance_m2(pose);
  settings.optics.noise = 6;
  const auto at_6 = TipBound(apparatus, settings).tip_variance_m2(pose);
  ASSERT_TRUE(at_3 && at_6);
  EXPECT_NEAR(*at_6 / *at_3, (36 + 1.0 / 12) / (9 + 1.0 / 12), 1e-6);
}

TEST(TipBound, WithoutATagInViewThereIsNone) {
  Apparatus apparatus = with_upper_tag();
  const Pose upside_down{{0, 0, 0.02}, Eigen::Quaterniond(0, 1, 0, 0)};
  EXPECT_FALSE(TipBound(apparatus, from_above()).tip_variance_m2(upside_down));
}

}  // namespace
}  // namespace heft
