// The synthetic camera's imitation of other cameras' faults, against closed forms: uneven light,
// tone curves, mosaic, sharpening, JPEG, and prints and a lens that deviate from their files.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tracking/Scenes.h"
#include "tracking/detection/ToneCurve.h"
#include "tracking/synthetic/Sensor.h"
#include "tracking/synthetic/SyntheticCamera.h"

namespace heft {
namespace {

constexpr int side = 64;
const Eigen::Vector2d middle_px(32, 32);

using Bgr = std::array<int, 3>;

// A picture with one level on its left half and another on its right half.
Image developed(const Optics& optics, const Bgr& left, const Bgr& right,
                const std::optional<Eigen::Vector2d>& effector_px = middle_px) {
  Levels levels;
  for (int i = 0; i < side * side; ++i)
    for (std::size_t channel = 0; channel < 3; ++channel)
      levels.push_back(static_cast<std::int16_t>(
          level_steps * (i % side < side / 2 + 1 ? left[channel] : right[channel])));
  return Sensor(optics, side, side, 1).develop(levels, 0, effector_px);
}

Image even(const Optics& optics, int level) {
  return developed(optics, {level, level, level}, {level, level, level});
}

Optics quiet() {
  return {.noise = 0};
}

Bgr at(const Image& image, int x, int y) {
  const auto place = 3 * static_cast<std::size_t>(y * image.width + x);
  return {image.pixels[place], image.pixels[place + 1], image.pixels[place + 2]};
}

TEST(SyntheticFaults, AShadowTakesLightOnOneSideOfTheEffector) {
  Optics optics = quiet();
  optics.shadow = 0.6;
  const Image image = even(optics, 200);
  const auto dark = std::lround(stored_of_light(0.4 * light_of_stored(200)).value);
  for (std::size_t channel = 0; channel < 3; ++channel) {
    EXPECT_EQ(at(image, 60, 60)[channel], 200);
    EXPECT_EQ(at(image, 4, 4)[channel], dark);
  }
  // The shadow's edge is at the effector, with a slope of 3 to 4; on the edge itself half of the
  // darkness.
  const double half = stored_of_light(0.7 * light_of_stored(200)).value;
  for (const int step : {-4, 0, 4})
    EXPECT_NEAR(at(image, 32 + 3 * step, 32 - 4 * step)[1], half, 1) << step;
  const Image without =
      developed(optics, {200, 200, 200}, {200, 200, 200}, std::nullopt);  // no effector
  for (const std::uint8_t value : without.pixels) ASSERT_EQ(value, 200);
}

TEST(SyntheticFaults, GlareAddsHalfItsLightAtItsReach) {
  Optics optics = quiet();
  optics.glare = 0.3;
  const Image image = even(optics, 100);
  const double light = light_of_stored(100);
  EXPECT_NEAR(at(image, 32, 32)[1], stored_of_light(light + 0.3).value, 0.6);
  EXPECT_NEAR(at(image, 32 + side / 16, 32)[1], stored_of_light(light + 0.15).value, 0.6);
  EXPECT_EQ(at(image, 0, 0)[1], 100);
  optics.glare = 1;
  EXPECT_EQ(at(even(optics, 100), 32, 32)[1], 255);
}

// Compares the stored values at even steps of light with the formula.
void expect_stored(const Optics& optics, const std::function<double(double)>& expected) {
  const LevelCurve curve(optics);
  for (double light = 0; light <= 1; light += 0.01)
    ASSERT_NEAR(curve.at(LevelCurve::place_of(static_cast<float>(light))) / 64.0,
                255 * expected(light), 0.03)
        << light;
}

double stored_part(double light) {
  return stored_of_light(light).value / 255;
}

TEST(SyntheticFaults, FilmHasAToeAndAShoulder) {
  const auto film = [](double light) {  // Narkowicz 2015, exposed by .8
    const double x = 0.8 * light;
    return stored_part(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14));
  };
  Optics optics;
  optics.film_curve = 1;
  expect_stored(optics, film);
  optics.film_curve = 0.25;
  expect_stored(optics,
                [&](double light) { return 0.75 * stored_part(light) + 0.25 * film(light); });
  EXPECT_GT(film(0.3), stored_part(0.3));
  EXPECT_LT(film(1), 0.9);
  // Stored white is the sensor's saturation.
  optics.film_curve = 1;
  const LevelCurve curve(optics);
  EXPECT_EQ(curve.at(LevelCurve::place_of(1.3F)), curve.at(LevelCurve::place_of(1)));
}

TEST(SyntheticFaults, AnSCurveIsSteepInTheMiddle) {
  Optics optics;
  optics.s_curve = 0.6;
  optics.gamma = 2;
  expect_stored(optics, [](double light) {
    const double v = std::sqrt(light);
    return 0.4 * v + 0.6 * v * v * (3 - 2 * v);
  });
}

// Mosaic, JPEG and sharpening do not change even areas, but each changes edges.
TEST(SyntheticFaults, WhatIsEvenStaysEven) {
  Optics mosaic = quiet(), sharp = quiet(), jpeg = quiet();
  mosaic.mosaic = true;
  sharp.sharpening = 1;
  jpeg.jpeg_quality = 80;
  const Bgr dark{60, 60, 60}, bright{200, 200, 200};
  const Image edge = developed(quiet(), dark, bright);
  for (const Optics& optics : {mosaic, sharp, jpeg}) {
    for (const std::uint8_t value : even(optics, 150).pixels) ASSERT_NEAR(value, 150, 1);
    EXPECT_NE(developed(optics, dark, bright).pixels, edge.pixels);
  }
}

// Even areas keep their color; at an edge of one color the other colors change, too.
TEST(SyntheticFaults, AMosaicKeepsOneColorOfEachPixel) {
  Optics optics = quiet();
  optics.mosaic = true;
  const Bgr left{40, 120, 210}, right{90, 160, 20};
  const Image image = developed(optics, left, right);
  for (int y = 1; y < side - 1; ++y)
    for (int x = 1; x < side - 1; ++x) {
      if (x < 31 || x > 34) {
        ASSERT_EQ(at(image, x, y), x < 31 ? left : right) << x << ' ' << y;
      }
    }
  // The last column on the left, 32, has blue and green, the next one green and red.
  EXPECT_EQ(at(image, 32, 32)[0], left[0]);
  EXPECT_EQ(at(image, 33, 33)[2], right[2]);
  EXPECT_EQ(at(image, 33, 32)[0], (left[0] + right[0]) / 2);
  EXPECT_EQ(at(image, 32, 33)[2], (left[2] + right[2]) / 2);
}

TEST(SyntheticFaults, SharpeningAddsWhatABlurTakesOff) {
  Optics optics = quiet();
  optics.sharpening = 1.5;
  const Image image = developed(optics, {100, 100, 100}, {140, 140, 140});
  // A Gaussian of 1 px, truncated at 3: its shares beyond the edge.
  double all = 0, beyond = 0;
  for (int i = -3; i <= 3; ++i) {
    all += std::exp(-0.5 * i * i);
    if (i > 0) beyond += std::exp(-0.5 * i * i);
  }
  EXPECT_NEAR(at(image, 32, 32)[1], 100 - 1.5 * 40 * beyond / all, 1.5);
  EXPECT_NEAR(at(image, 33, 32)[1], 140 + 1.5 * 40 * beyond / all, 1.5);
}

TEST(SyntheticFaults, JpegIsTheWorseTheLowerItsQuality) {
  const auto error = [](int quality) {
    Optics optics = {.noise = 8}, plain = {.noise = 8};
    optics.jpeg_quality = quality;
    const Image image = even(optics, 128), before = even(plain, 128);
    double sum = 0;
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
      sum += std::pow(image.pixels[i] - before.pixels[i], 2);
    return std::sqrt(sum / static_cast<double>(image.pixels.size()));
  };
  EXPECT_GT(error(20), error(80));
  EXPECT_GT(error(80), error(98));
  EXPECT_LT(error(98), 2);
}

Optics all_faults() {
  Optics optics;
  optics.shadow = 0.4;
  optics.glare = 0.2;
  optics.film_curve = optics.s_curve = 0.5;
  optics.mosaic = true;
  optics.sharpening = 0.7;
  optics.jpeg_quality = 80;
  optics.readout_s = 0.02;
  return optics;
}

const SyntheticCamera::EffectorPath moving = [](double t_s) {
  return std::optional<Pose>({{0.3 * t_s, 0, 0.05}, Eigen::Quaterniond::Identity()});
};

TEST(SyntheticFaults, EqualSeedsGiveEqualBytesWithAllOfThem) {
  SyntheticSettings settings;
  settings.optics = all_faults();
  SyntheticCamera a(default_apparatus(640), settings, 11), b(default_apparatus(640), settings, 11);
  const Image first = a.picture(moving, 0.1, 3);
  a.picture([](double) { return std::nullopt; }, 0.2, 4);
  EXPECT_EQ(a.picture(moving, 0.1, 3).pixels, first.pixels);
  EXPECT_EQ(b.picture(moving, 0.1, 3).pixels, first.pixels);
  EXPECT_NE(a.picture(moving, 0.1, 4).pixels, first.pixels);
}

// A shadow of strength 0 changes nothing, also in the path for uneven light.
TEST(SyntheticFaults, UnevenLightThatIsEvenChangesNothing) {
  SyntheticSettings settings;
  settings.optics.noise = 0;
  settings.optics.film_curve = 0.5;
  SyntheticSettings lit = settings;
  lit.optics.glare = 1e-9;
  const Image plain = SyntheticCamera(default_apparatus(640), settings, 1).picture(moving, 0, 0);
  const Image told = SyntheticCamera(default_apparatus(640), lit, 1).picture(moving, 0, 0);
  for (std::size_t i = 0; i < plain.pixels.size(); ++i)
    ASSERT_NEAR(plain.pixels[i], told.pixels[i], 1);
}

SyntheticSettings noiseless(const Optics& faults) {
  SyntheticSettings settings;
  settings.optics = faults;
  settings.optics.noise = 0;
  return settings;
}

Image filmed(SyntheticCamera camera, double t_s) {
  return camera.picture(out_of_view, t_s, 0);
}

double mean_of(const Image& image, std::size_t channel, int first_row, int last_row) {
  double sum = 0;
  for (int y = first_row; y < last_row; ++y)
    for (int x = 0; x < image.width; ++x) sum += light_of_stored(at(image, x, y)[channel]);
  return sum / (image.width * (last_row - first_row));
}

TEST(SyntheticFaults, ADenoisingCameraKeepsAShareOfTheLastPicture) {
  const Apparatus apparatus = default_apparatus(640);
  SyntheticCamera camera(apparatus, noiseless({.last_picture = 0.3}), 1);
  SyntheticCamera plain(apparatus, noiseless({}), 1);
  const Image first = camera.picture(moving, 0, 0), second = camera.picture(moving, 0.1, 1);
  const Image before = plain.picture(moving, 0, 0), now = plain.picture(moving, 0.1, 1);
  EXPECT_EQ(first.pixels, before.pixels);
  for (std::size_t i = 0; i < now.pixels.size(); ++i)
    ASSERT_NEAR(second.pixels[i], 0.7 * now.pixels[i] + 0.3 * before.pixels[i], 0.51);
  camera.restart();
  EXPECT_EQ(camera.picture(moving, 0.1, 1).pixels, now.pixels);
}

TEST(SyntheticFaults, GainAndWhiteBalanceChangeSlowly) {
  const Apparatus apparatus = default_apparatus(640);
  const auto light = [&](const Optics& optics, double t_s, std::size_t channel) {
    return mean_of(filmed({apparatus, noiseless(optics), 1}, t_s), channel, 0, 480);
  };
  const double usual = light({.exposure = 0.5}, 0, 1);
  EXPECT_NEAR(light({.exposure = 0.5, .auto_gain = 0.2}, 1, 1) / usual, 1.2, 0.005);
  EXPECT_NEAR(light({.exposure = 0.5, .auto_gain = 0.2}, 3, 1) / usual, 0.8, 0.005);
  const Optics balancing{.exposure = 0.5, .auto_white_balance = 0.2};
  EXPECT_NEAR(light(balancing, 1.25, 2) / light(balancing, 0, 2), 1.2, 0.005);
  EXPECT_NEAR(light(balancing, 1.25, 0) / light(balancing, 0, 0), 0.8, 0.005);
}

// A quarter of a period is 2.5 ms; an exposure of 4 ms sees 76 % of the amplitude.
TEST(SyntheticFaults, FlickerIsOf100HzAndShowsAsBands) {
  const Apparatus apparatus = default_apparatus(640);
  const Optics usual{.exposure = 0.5, .readout_s = 0.02};
  Optics flickering = usual;
  flickering.flicker = 0.2;
  const Image even = filmed({apparatus, noiseless(usual), 1}, 0);
  const Image banded = filmed({apparatus, noiseless(flickering), 1}, 0);
  const auto ratio = [&](int row) {
    return mean_of(banded, 1, row - 4, row + 4) / mean_of(even, 1, row - 4, row + 4);
  };
  EXPECT_NEAR(ratio(60), 1 + 0.2 * 0.757, 0.01);
  EXPECT_NEAR(ratio(180), 1 - 0.2 * 0.757, 0.01);
  EXPECT_NEAR(ratio(240), 1, 0.02);
}

TEST(SyntheticFaults, ALensThatBreathesChangesItsFocalLength) {
  const Apparatus apparatus = default_apparatus(640);
  SyntheticSettings longer = noiseless({});
  longer.files.focal_length_scale = 1.004;
  EXPECT_EQ(filmed({apparatus, noiseless({.breathing = 0.004}), 1}, 0.75).pixels,
            filmed({apparatus, longer, 1}, 0.75).pixels);
}

TEST(SyntheticFaults, PicturesAreRepeatedAndLostAsOftenAsIsSaid) {
  const Apparatus apparatus = default_apparatus(640);
  SyntheticSettings settings;
  settings.optics.repeated = 0.3;
  settings.optics.dropped = 0.2;
  SyntheticCamera camera(apparatus, settings, 5);
  Image last;
  int n_repeated = 0, n_dropped = 0;
  for (std::uint64_t i = 0; i < 100; ++i) {
    const Image now = camera.picture(out_of_view, 0, i);
    n_repeated += now.pixels == last.pixels;
    n_dropped += camera.drops(i);
    last = now;
  }
  EXPECT_NEAR(n_repeated, 30, 14);
  EXPECT_NEAR(n_dropped, 20, 12);
}

// With wrong files, the picture shows the true board, effector and lens.
TEST(SyntheticFaults, FilesAreWrongByWhatIsSaid) {
  const Apparatus told = default_apparatus(640);
  Apparatus real = told;
  for (MarkerBody* body : {&real.board, &real.effector})
    for (Tag& tag : body->tags) {
      const Eigen::Vector3d center_m = tag_center_m(tag);
      const double scale = body == &real.board ? 1.02 : 0.97;
      for (Eigen::Vector3d& corner_m : tag.corners_m)
        corner_m = center_m + scale * (corner_m - center_m);
    }
  real.camera.fx_px *= 1.01;
  real.camera.fy_px *= 1.01;
  SyntheticSettings settings;
  const Image as_told = SyntheticCamera(told, settings, 1).picture(moving, 0, 0);
  const Image as_it_is = SyntheticCamera(real, settings, 1).picture(moving, 0, 0);
  settings.files = {1.02, 0.97, 1.01};
  const Image wrong = SyntheticCamera(told, settings, 1).picture(moving, 0, 0);
  EXPECT_NE(as_told.pixels, as_it_is.pixels);
  EXPECT_EQ(wrong.pixels, as_it_is.pixels);
}

}  // namespace
}  // namespace heft
