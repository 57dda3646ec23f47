// Exactly known edges: pictures of a straight step, blurred as light and stored as sRGB, computed
// here from the formula.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/Random.h"
#include "tracking/detection/EdgeFit.h"

namespace heft {
namespace {

struct Step {
  Eigen::Vector2d start{20.3, 31.2}, end{61.8, 37.9};  ///< bright on its left, as seen on screen
  double dark = 0.04, bright = 0.7, blur_px = 0.7, noise = 0;
  bool srgb = true;
};

double srgb_of(double light) {
  return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
}

double outwards(const Step& step, const Eigen::Vector2d& pixel) {
  const Eigen::Vector2d along = (step.end - step.start).normalized();
  return (pixel - step.start).dot(Eigen::Vector2d(along.y(), -along.x()));
}

Image picture_of(const Step& step, RandomStream& random) {
  Image image(80, 70, 1);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const double q = outwards(step, {x, y}) / step.blur_px;
      const double light =
          step.dark + (step.bright - step.dark) * std::erfc(-q / std::sqrt(2.0)) / 2;
      const double value =
          255 * (step.srgb ? srgb_of(light) : light) + step.noise * random.normal();
      image.pixels[static_cast<std::size_t>(y * image.width + x)] =
          static_cast<std::uint8_t>(std::clamp(std::round(value), 0.0, 255.0));
    }
  return image;
}

EdgeGuess guess_off_by(const Step& step, double start_px, double end_px) {
  const Eigen::Vector2d along = (step.end - step.start).normalized();
  const Eigen::Vector2d normal(along.y(), -along.x());
  EdgeGuess guess;
  guess.start_px = step.start + start_px * normal;
  guess.end_px = step.end + end_px * normal;
  guess.cell_px = 6;
  return guess;
}

double furthest_off_px(const Step& step, const FittedEdge& edge) {
  double furthest = 0;
  for (const auto& point : {edge.points_px[0], edge.points_px[1], edge.start_px, edge.end_px})
    furthest = std::max(furthest, std::abs(outwards(step, point)));
  return furthest;
}

TEST(EdgeFit, FindsABlurredStepToAHundredthOfAPixel) {
  RandomStream random(1, "edge");
  for (const double blur_px : {0.5, 0.7, 1.0, 1.4}) {
    Step step;
    step.blur_px = blur_px;
    const FittedEdge edge = fit_edge(picture_of(step, random), guess_off_by(step, 0.4, -0.6), 500);
    EXPECT_LT(furthest_off_px(step, edge), 0.01) << blur_px;
    EXPECT_EQ(edge.quality, 1);
    EXPECT_NEAR(edge.blur_px, blur_px, 0.05);
    EXPECT_NEAR(edge.bright, 255 * srgb_of(0.7), 2);
    EXPECT_NEAR(edge.dark, 255 * srgb_of(0.04), 2);
  }
}

TEST(EdgeFit, WithoutToneCurveTheEdgeLooksMoved) {
  // The bias that the tracker takes from the board: stored light read as sRGB.
  Step step;
  step.srgb = false;
  RandomStream random(2, "edge");
  const FittedEdge edge = fit_edge(picture_of(step, random), guess_off_by(step, 0, 0), 500);
  EXPECT_GT(outwards(step, edge.points_px[0]), 0.1);
}

TEST(EdgeFit, ErrorsAreAsLargeAsItSays) {
  Step step;
  step.noise = 4;
  RandomStream random(3, "edge");
  double sum = 0;
  constexpr int n = 200;
  for (int i = 0; i < n; ++i) {
    step.start.y() = 31 + random.uniform();
    step.end.y() = 36 + 2 * random.uniform();
    const FittedEdge edge = fit_edge(picture_of(step, random), guess_off_by(step, 0.2, 0.1), 500);
    for (const auto& point : edge.points_px) {
      const double relative = outwards(step, point) / edge.sd_px;
      sum += relative * relative / (2 * n);
    }
  }
  EXPECT_GT(std::sqrt(sum), 0.75);
  EXPECT_LT(std::sqrt(sum), 1.3);
}

TEST(EdgeFit, SaturatedWhiteDoesNotPull) {
  Step step;
  step.bright = 1.5;
  step.noise = 3;
  RandomStream random(4, "edge");
  const FittedEdge edge = fit_edge(picture_of(step, random), guess_off_by(step, 0.2, 0.2), 500);
  EXPECT_TRUE(edge.saturated);
  EXPECT_LT(furthest_off_px(step, edge), 0.2);  // a plain half-way crossing is .3 px off
}

TEST(EdgeFit, WhiteOfADrawingIsNotSaturated) {
  RandomStream random(4, "edge");
  for (const double noise : {0.0, 3.0})
    for (const double blur_px : {0.3, 0.5, 1.0}) {
      Step step{.dark = 0, .bright = 1, .blur_px = blur_px, .noise = noise};
      const FittedEdge edge = fit_edge(picture_of(step, random), guess_off_by(step, 0.3, 0.2), 500);
      EXPECT_FALSE(edge.saturated) << noise << ' ' << blur_px;
      EXPECT_LT(furthest_off_px(step, edge), noise > 0 ? 0.06 : 0.03) << noise << ' ' << blur_px;
      EXPECT_GT(edge.quality, 0.97) << noise << ' ' << blur_px;
    }
}

TEST(EdgeFit, SomethingOverAPartOfTheEdgeIsLeftOut) {
  Step step;
  RandomStream random(5, "edge");
  Image image = picture_of(step, random);
  for (int y = 0; y < image.height; ++y)
    for (int x = 20; x < 26; ++x) image.pixels[static_cast<std::size_t>(y * 80 + x)] = 130;
  const FittedEdge edge = fit_edge(image, guess_off_by(step, 0.2, 0.2), 500);
  EXPECT_LT(furthest_off_px(step, edge), 0.06);
  EXPECT_LT(edge.quality, 0.97);
  EXPECT_GT(edge.quality, 0.7);
}

TEST(EdgeFit, FollowsABentEdge) {
  // Bent as by a lens: a parabola through the ends, 0.3 px outwards in the middle.
  Step step;
  RandomStream random(6, "edge");
  Image image(80, 70, 1);
  const Eigen::Vector2d along = (step.end - step.start).normalized();
  for (int y = 0; y < 70; ++y)
    for (int x = 0; x < 80; ++x) {
      const double u =
          2 * (Eigen::Vector2d(x, y) - step.start).dot(along) / (step.end - step.start).norm() - 1;
      const double q = (outwards(step, {x, y}) - 0.3 * (1 - u * u)) / step.blur_px;
      const double light = 0.04 + 0.66 * std::erfc(-q / std::sqrt(2.0)) / 2;
      image.pixels[static_cast<std::size_t>(y * 80 + x)] =
          static_cast<std::uint8_t>(std::lround(255 * srgb_of(light)));
    }
  EdgeGuess guess = guess_off_by(step, 0.1, 0.1);
  guess.sag_px = 0.3;
  const FittedEdge edge = fit_edge(image, guess, 500);
  EXPECT_NEAR(outwards(step, edge.start_px), 0, 0.01);
  EXPECT_NEAR(outwards(step, edge.end_px), 0, 0.01);
}

TEST(EdgeFit, NoEdgeHasNoQuality) {
  RandomStream random(7, "edge");
  Step flat, turned;
  flat.bright = flat.dark;
  flat.noise = 4;
  EXPECT_EQ(fit_edge(picture_of(flat, random), guess_off_by(flat, 0, 0), 500).quality, 0);
  EdgeGuess wrong_side = guess_off_by(turned, 0, 0);
  wrong_side.bright_outside = false;
  EXPECT_EQ(fit_edge(picture_of(turned, random), wrong_side, 500).quality, 0);
  EdgeGuess outside = guess_off_by(turned, 0, 0);
  outside.start_px = {-50, -50};
  outside.end_px = {-10, -52};
  EXPECT_EQ(fit_edge(picture_of(turned, random), outside, 500).quality, 0);
  EdgeGuess nothing;
  nothing.start_px = nothing.end_px = {10, 10};
  EXPECT_EQ(fit_edge(picture_of(turned, random), nothing, 500).quality, 0);
}

}  // namespace
}  // namespace heft
