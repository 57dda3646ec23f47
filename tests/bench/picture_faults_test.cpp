// What other cameras do to a picture, against what can be said of it in closed form.
#include <gtest/gtest.h>

#include <cmath>

#include "bench/tracking/PictureFaults.h"
#include "tracking/ToneCurve.h"

namespace heft {
namespace {

const Eigen::Vector2d middle_px(32, 32);

Image gray_picture(int value) {
  Image image(64, 64, 1);
  std::fill(image.pixels.begin(), image.pixels.end(), static_cast<std::uint8_t>(value));
  return image;
}

int at(const Image& image, int x, int y) {
  return image
      .pixels[static_cast<std::size_t>(y) * image.row_bytes() + static_cast<std::size_t>(x)];
}

PictureFaults none() {
  PictureFaults faults;
  faults.noise = 0;
  return faults;
}

TEST(PictureFaults, WithoutAnyAPictureIsWhatItWas) {
  Image image = gray_picture(0);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = static_cast<std::uint8_t>(i % 256);
  EXPECT_EQ(with_faults(image, none(), middle_px, 1).pixels, image.pixels);
}

TEST(PictureFaults, AShadowTakesLightOnOneSide) {
  PictureFaults faults = none();
  faults.shadow = 0.4;
  const Image image = with_faults(gray_picture(200), faults, middle_px, 1);
  EXPECT_EQ(at(image, 60, 60), 200);
  EXPECT_NEAR(at(image, 4, 4), stored_of_light(0.4 * light_of_stored(200)).value, 1);
}

TEST(PictureFaults, GlareAddsHalfItsLightAtItsReach) {
  PictureFaults faults = none();
  faults.glare = 0.3;
  const Image image = with_faults(gray_picture(100), faults, middle_px, 1);
  EXPECT_NEAR(at(image, 32, 32), stored_of_light(light_of_stored(100) + 0.3).value, 1);
  EXPECT_NEAR(at(image, 36, 32), stored_of_light(light_of_stored(100) + 0.15).value, 1);
}

TEST(PictureFaults, NoiseIsAsLargeAsItSays) {
  PictureFaults faults = none();
  faults.noise = 10;
  const Image image = with_faults(gray_picture(128), faults, middle_px, 1);
  double sum = 0;
  for (const std::uint8_t value : image.pixels) sum += std::pow(value - 128.0, 2);
  EXPECT_NEAR(std::sqrt(sum / static_cast<double>(image.pixels.size())), 10, 0.5);
}

// A mosaic, JPEG's first wave and sharpening leave evenness alone, and none leaves an edge alone.
TEST(PictureFaults, WhatIsEvenStaysEven) {
  PictureFaults mosaic = none(), sharp = none(), jpeg = none();
  mosaic.mosaic = true;
  sharp.sharpening = 1;
  jpeg.jpeg_quality = 80;
  Image edge = gray_picture(60);
  for (int y = 0; y < 64; ++y)
    for (int x = 33; x < 64; ++x) edge.pixels[static_cast<std::size_t>(64 * y + x)] = 200;
  for (const PictureFaults& faults : {mosaic, sharp, jpeg}) {
    const Image image = with_faults(gray_picture(150), faults, middle_px, 1);
    for (const std::uint8_t value : image.pixels) ASSERT_NEAR(value, 150, 1);
    EXPECT_NE(with_faults(edge, faults, middle_px, 1).pixels, edge.pixels);
  }
}

TEST(PictureFaults, TonesOfNoShareAreSrgb) {
  for (const double light : {0.05, 0.3, 0.9}) {
    EXPECT_NEAR(film_tone(light, 0), stored_of_light(light).value / 255, 1e-9);
    EXPECT_NEAR(s_curve_tone(light, 0), stored_of_light(light).value / 255, 1e-9);
  }
  EXPECT_GT(film_tone(0.3, 1), stored_of_light(0.3).value / 255);  // its shoulder
}

}  // namespace
}  // namespace heft
