// Conversion of light to bytes, against the formulas; and that a part of a picture is exposed like
// the whole.
#include "tracking/synthetic/Sensor.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/Random.h"

namespace heft {
namespace {

// Light from 0 to 1 in 16384 steps, one a pixel of the picture.
LightPicture ramp() {
  LightPicture picture(fine_of({0, 0, 128, 128}));
  for (int y = 0; y < picture.box.y1; ++y)
    for (int x = 0; x < picture.box.x1; ++x) {
      const int step = y / fineness * 128 + x / fineness;
      picture.row(y)[x].setConstant(static_cast<float>(step) / 16383);
    }
  return picture;
}

double srgb(double light) {  // IEC 61966-2-1
  return 255 * (light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055);
}

TEST(Sensor, StoresLightAsTheToneCurveSays) {
  for (const std::optional<double> gamma : {std::optional<double>(), {1.0}, {1.8}}) {
    Sensor sensor({.blur_px = 0, .gamma = gamma, .vignetting = 0, .noise = 0}, 128, 128, 1);
    const LightPicture picture = ramp();
    Levels levels;
    sensor.expose(picture, RowSpans::whole({0, 0, 128, 128}), levels);
    double worst = 0;
    for (std::size_t i = 0; i < 128 * 128; ++i) {
      const double light = static_cast<double>(i) / 16383;
      const double expected = gamma ? 255 * std::pow(light, 1 / *gamma) : srgb(light);
      worst = std::max(worst, std::abs(levels[3 * i + 1] / 64.0 - expected));
    }
    EXPECT_LT(worst, 0.015);  // levels are whole 64ths, which alone is 0.008
  }
}

LightPicture random_picture(RandomStream& random, const PixelBox& box) {
  LightPicture picture(box);
  for (Light& light : picture.light)
    for (float& value : light) value = static_cast<float>(random.uniform());
  return picture;
}

RC_GTEST_PROP(Sensor, ExposesAPartLikeTheWhole, ()) {
  RandomStream random(*rc::gen::arbitrary<std::uint64_t>(), "sensor");
  const PixelBox box{0, 0, 23, 17};
  const LightPicture picture = random_picture(random, fine_of(box));
  Sensor sensor({.noise = 0}, box.width(), box.height(), 1);
  Levels whole, part(23 * 17 * 3, -1);
  sensor.expose(picture, RowSpans::whole(box), whole);
  RowSpans spans(box);
  for (int y = 0; y < box.height(); ++y) {
    const int begin = *rc::gen::inRange(0, 23);
    spans.at(y) = {begin, *rc::gen::inRange(begin, 24)};
  }
  sensor.expose(picture, spans, part);
  for (int y = 0; y < box.height(); ++y)
    for (int x = 0; x < box.width(); ++x) {
      const bool within = x >= spans.at(y).begin && x < spans.at(y).end;
      const auto i = static_cast<std::size_t>(sensor.place_of(x, y));
      RC_ASSERT(part[i] == (within ? whole[i] : -1));
    }
}

// A sum of eight uniform numbers: kurtosis 3 - 1.2 / 8, so tails nearly like the normal's.
TEST(Sensor, NoiseHasNormalTailsAndIsTheSameInAllChannels) {
  constexpr int width = 640, height = 480;
  const Sensor sensor({.noise = 8}, width, height, 3);
  const Image image = sensor.develop(Levels(width * height * 3, 128 * level_steps), 0);
  double sum_2 = 0, sum_4 = 0;
  int n_beyond_3_sd = 0;
  for (std::size_t i = 0; i < image.pixels.size(); i += 3) {
    ASSERT_EQ(image.pixels[i], image.pixels[i + 1]);
    ASSERT_EQ(image.pixels[i], image.pixels[i + 2]);
    const double noise = image.pixels[i] - 128.0;
    sum_2 += noise * noise;
    sum_4 += std::pow(noise, 4);
    if (std::abs(noise) > 24) ++n_beyond_3_sd;
  }
  const double n = width * height, variance = sum_2 / n;
  EXPECT_NEAR(std::sqrt(variance), 8, 0.05);
  EXPECT_NEAR(sum_4 / n / (variance * variance), 3 - 1.2 / 8, 0.05);
  // P(|S - 4| > t) of the sum S of eight (Irwin and Hall) is 2 / 8! (u^8 - 8 (u - 1)^8), u = 4 - t.
  const double u = 4 - 24.5 / 8 * std::sqrt(8.0 / 12);
  const double expected = 2 / 40320.0 * (std::pow(u, 8) - 8 * std::pow(u - 1, 8));
  EXPECT_NEAR(n_beyond_3_sd / n, expected, 0.15 * expected);
}

// Bright pixels must not wrap around to dark ones: noise is limited to the range of 16 bits.
TEST(Sensor, NoiseLargerThanAllLevelsSaturates) {
  const Sensor sensor({.noise = 5000}, 64, 64, 3);
  const auto [least, white_share] = [&] {
    const Image image = sensor.develop(Levels(64 * 64 * 3, 300 * level_steps), 0);
    const auto n_white = std::ranges::count(image.pixels, 255);
    return std::pair(*std::ranges::min_element(image.pixels),
                     static_cast<double>(n_white) / static_cast<double>(image.pixels.size()));
  }();
  EXPECT_EQ(least, 300 - 208);
  EXPECT_NEAR(white_share, 0.5, 0.03);
}

// Noise is added before white is clipped, so that overexposed white has none.
TEST(Sensor, OverexposedWhiteHasNoNoise) {
  const auto whites = [](double exposure) {
    Sensor sensor({.blur_px = 0, .vignetting = 0, .exposure = exposure, .noise = 3}, 32, 32, 1);
    LightPicture picture(fine_of({0, 0, 32, 32}));
    for (Light& light : picture.light) light.setConstant(1);
    Levels levels;
    sensor.expose(picture, RowSpans::whole({0, 0, 32, 32}), levels);
    return std::ranges::count(sensor.develop(levels, 0).pixels, 255);
  };
  EXPECT_EQ(whites(1.5), 32 * 32 * 3);
  EXPECT_NEAR(static_cast<double>(whites(1)), 0.56 * 32 * 32 * 3, 200);  // P(noise > -.5 level)
}

// The profile of a vertical edge, at any position in a pixel: the normal distribution of the blur,
// convolved with a pixel's extent.
TEST(Sensor, AnEdgesProfileIsNormal) {
  constexpr double blur_px = 0.6, light = 1 / 1.05;
  Sensor sensor({.blur_px = blur_px, .gamma = 1, .vignetting = 0, .noise = 0}, 24, 1, 1);
  const auto below = [&](double x) { return 0.5 * std::erfc(-x / blur_px / std::sqrt(2)); };
  const auto integral = [&](double x) {
    return x * below(x) +
           blur_px * std::exp(-x * x / (2 * blur_px * blur_px)) / std::sqrt(2 * M_PI);
  };
  double worst = 0;
  for (double edge = 10; edge < 11; edge += 0.07) {
    AreaRaster raster;
    const double side = fineness * (edge + 0.5) - 0.5;  // of fine pixels
    raster.begin(fine_of({0, 0, 24, 1}));
    const std::vector<Eigen::Vector2d> bright{{side, -9}, {99, -9}, {99, 9}, {side, 9}};
    raster.add(bright, Light::Constant(static_cast<float>(light)));
    LightPicture picture(raster.box());
    raster.draw_behind(picture);
    Levels levels;
    sensor.expose(picture, RowSpans::whole({0, 0, 24, 1}), levels);
    for (int x = 0; x < 20; ++x) {
      const double expected = light * (integral(x + 0.5 - edge) - integral(x - 0.5 - edge));
      const double seen = levels[static_cast<std::size_t>(sensor.place_of(x, 0))] / 64.0 / 255;
      worst = std::max(worst, std::abs(seen - expected));
    }
  }
  EXPECT_LT(worst, 0.012);  // 0.057 of light drawn in whole pixels
}

struct Distances {
  int columns, rows;
};

RC_GTEST_PROP(RowSpans, GrowByAllThatIsNear, ()) {
  const PixelBox box{3, 5, 15, 14};
  RowSpans spans(box);
  for (int y = box.y0; y < box.y1; ++y) {
    const int begin = *rc::gen::inRange(box.x0, box.x1);
    spans.at(y) = {begin, *rc::gen::inRange(begin, box.x1 + 1)};
  }
  const Distances by{*rc::gen::inRange(0, 4), *rc::gen::inRange(0, 4)};
  const RowSpans grown = spans.grown(by.columns, by.rows);
  for (int y = box.y0; y < box.y1; ++y) {
    for (int x = box.x0; x < box.x1; ++x) {
      if (x < spans.at(y).begin || x >= spans.at(y).end) continue;
      for (int near_y = std::max(box.y0, y - by.rows); near_y < std::min(box.y1, y + by.rows + 1);
           ++near_y) {
        RC_ASSERT(grown.at(near_y).begin <= std::max(box.x0, x - by.columns));
        RC_ASSERT(grown.at(near_y).end >= std::min(box.x1, x + by.columns + 1));
        RC_ASSERT(grown.at(near_y).begin >= box.x0 && grown.at(near_y).end <= box.x1);
      }
    }
  }
}

}  // namespace
}  // namespace heft
