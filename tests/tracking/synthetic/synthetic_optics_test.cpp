// Lens and sensor: tone curve, exposure, vignetting, noise; and that equal seeds give equal bytes.
#include <gtest/gtest.h>

#include <cmath>

#include "base/Error.h"
#include "tracking/Scenes.h"
#include "tracking/detection/TagDetector.h"
#include "tracking/detection/TagFamily.h"
#include "tracking/synthetic/AreaRaster.h"
#include "tracking/synthetic/SyntheticCamera.h"

namespace heft {
namespace {

using Eigen::Vector3d;

Image still_picture(const Optics& optics, std::uint64_t seed = 1, std::uint64_t number = 0,
                    const Apparatus& apparatus = default_apparatus(640)) {
  SyntheticSettings settings;
  settings.optics = optics;
  return SyntheticCamera(apparatus, settings, seed).picture(out_of_view, 0, number);
}

int level(const Image& image, int x, int y, int channel = 1) {
  return image.pixels[static_cast<std::size_t>((y * image.width + x) * 3 + channel)];
}

// A pixel in the white between four tags, near the middle of the picture.
int paper_level(const Image& image) {
  const SyntheticSettings settings;
  const auto pixel =
      project(default_camera(640, 480), settings.camera_from_board * Vector3d(0, 0, 0));
  return level(image, static_cast<int>(std::lround(pixel.x())),
               static_cast<int>(std::lround(pixel.y())));
}

TEST(SyntheticOptics, PaperHasTheLevelOfItsLight) {
  constexpr double paper = 0.85;
  Optics optics{.blur_px = 0, .vignetting = 0, .noise = 0};
  EXPECT_EQ(paper_level(still_picture(optics)),
            std::lround(255 * (1.055 * std::pow(paper, 1 / 2.4) - 0.055)));
  optics.exposure = 0.5;
  EXPECT_EQ(paper_level(still_picture(optics)),
            std::lround(255 * (1.055 * std::pow(paper / 2, 1 / 2.4) - 0.055)));
  optics.gamma = 1;
  EXPECT_EQ(paper_level(still_picture(optics)), std::lround(255 * paper / 2));
  optics.exposure = 1.6;
  EXPECT_EQ(paper_level(still_picture(optics)), 255);
}

TEST(SyntheticOptics, VignettingTakesItsShareOfTheLightInTheCorners) {
  Optics optics{.gamma = 1, .vignetting = 0, .exposure = 2.2, .noise = 0};
  const Image even = still_picture(optics);
  optics.vignetting = 0.3;
  const Image dark = still_picture(optics);
  const auto ratio = [&](int x, int y) {
    return static_cast<double>(level(dark, x, y, 2)) / level(even, x, y, 2);  // wood is red
  };
  EXPECT_NEAR(ratio(0, 0), 0.7, 0.006);
  EXPECT_NEAR(ratio(639, 479), 0.7, 0.006);
  EXPECT_NEAR(ratio(0, 240), 1 - 0.3 * 0.64, 0.006);  // (320 / 400) squared
}

TEST(SyntheticOptics, BlurHasTheSpreadThatWasAsked) {
  for (const double blur_px : {0.6, 1.5}) {
    const Optics optics{.blur_px = blur_px, .gamma = 1, .vignetting = 0, .noise = 0};
    SyntheticSettings settings;
    settings.optics = optics;
    // Straight down: the sheet's edges are upright in the picture.
    settings.camera_from_board = {{0, 0, 0.3}, Eigen::Quaterniond(0, 1, 0, 0)};
    Apparatus pinhole{default_camera(1280, 720), grid_board(1, 1, 0.08, 0.1), {}};
    pinhole.camera.distortion = {};
    const Image image = SyntheticCamera(pinhole, settings, 1).picture(out_of_view, 0, 0);
    const double edge = pinhole.camera.cx_px - 1000 * 0.04 / 0.3;  // left side of the black border
    double mass = 0, first = 0, second = 0;
    const int reach = static_cast<int>(std::ceil(4.5 * blur_px));
    for (int x = static_cast<int>(edge) - reach; x <= edge + reach; ++x) {
      const double step = level(image, x, 359) - level(image, x + 1, 359), place = x + 0.5 - edge;
      mass += step;
      first += step * place;
      second += step * place * place;
    }
    EXPECT_NEAR(first / mass, 0, 0.02);  // bytes alone leave that much, and as much of the spread
    // A pixel's extent, twice, less what light is drawn in, more what there is of it on the edge.
    const double fine_px = 1.0 / fineness, place = (edge + 0.5) / fine_px;
    const double covered = place - std::floor(place);
    const double sharp_variance = 1.0 / 6 + fine_px * fine_px * (covered * (1 - covered) - 1.0 / 6);
    EXPECT_NEAR(std::sqrt(second / mass - std::pow(first / mass, 2) - sharp_variance), blur_px,
                0.02);
  }
}

struct NoiseFigures {
  double mean = 0, sd = 0, correlation = 0;
};

// Noise of two pictures, at pixels far enough below saturation.
NoiseFigures noise_of(const Image& a, const Image& b, const Image& clean) {
  double sum = 0, sum_aa = 0, sum_ab = 0;
  int n = 0;
  for (int y = 0; y < 100; ++y) {
    for (int x = 0; x < 640; ++x, ++n) {
      const double in_a = level(a, x, y) - level(clean, x, y);
      const double in_b = level(b, x, y) - level(clean, x, y);
      sum += in_a;
      sum_aa += in_a * in_a;
      sum_ab += in_a * in_b;
    }
  }
  return {sum / n, std::sqrt(sum_aa / n), sum_ab / sum_aa};
}

TEST(SyntheticOptics, NoiseHasTheSpreadThatWasAskedAndIsNewInEveryPicture) {
  for (const double noise : {3.0, 8.0}) {
    const Image clean = still_picture({.noise = 0});
    SyntheticSettings settings;
    settings.optics.noise = noise;
    SyntheticCamera camera(default_apparatus(640), settings, 1);
    const NoiseFigures figures =
        noise_of(camera.picture(out_of_view, 0, 0), camera.picture(out_of_view, 0, 1), clean);
    EXPECT_NEAR(figures.mean, 0, 0.05);
    EXPECT_NEAR(figures.sd, std::hypot(noise, std::sqrt(1.0 / 6)), 0.02 * noise);  // two roundings
    EXPECT_NEAR(figures.correlation, 0, 0.02);
  }
}

TEST(SyntheticOptics, NeighborsHaveNoiseOfTheirOwn) {
  const Image clean = still_picture({.noise = 0}), noisy = still_picture({.noise = 8});
  const auto noise_at = [&](int x, int y) { return level(noisy, x, y) - level(clean, x, y); };
  double beside = 0, below = 0, own = 0;
  for (int y = 0; y < 100; ++y) {
    for (int x = 0; x < 639; ++x) {
      own += noise_at(x, y) * noise_at(x, y);
      beside += noise_at(x, y) * noise_at(x + 1, y);
      below += noise_at(x, y) * noise_at(x, y + 1);
    }
  }
  EXPECT_NEAR(beside / own, 0, 0.02);
  EXPECT_NEAR(below / own, 0, 0.02);
}

TEST(SyntheticOptics, EqualSeedsAndNumbersGiveEqualBytes) {
  const auto moving = [](double t_s) {
    return std::optional<Pose>({{0.3 * t_s, 0, 0.05}, Eigen::Quaterniond::Identity()});
  };
  SyntheticCamera a(default_apparatus(640), {}, 11), b(default_apparatus(640), {}, 11);
  SyntheticCamera other(default_apparatus(640), {}, 12);
  const Image first = a.picture(moving, 0.1, 3);
  a.picture(moving, 0.2, 4);  // what was asked for in between does not matter
  EXPECT_EQ(a.picture(moving, 0.1, 3).pixels, first.pixels);
  EXPECT_EQ(b.picture(moving, 0.1, 3).pixels, first.pixels);
  EXPECT_NE(a.picture(moving, 0.1, 4).pixels, first.pixels);
  EXPECT_NE(other.picture(moving, 0.1, 3).pixels, first.pixels);
}

class EveryFamily : public testing::TestWithParam<std::string_view> {};

TEST_P(EveryFamily, IsFoundAgainByTheDetector) {
  Apparatus apparatus = default_apparatus(640);
  apparatus.effector = {};
  apparatus.board = grid_board(3, 2, 0.040, 0.100);
  apparatus.board.family = GetParam();
  for (Tag& tag : apparatus.board.tags) tag.id = tag.id * 5 % n_tags_of(apparatus.board.family);
  const Image image = still_picture({}, 1, 0, apparatus);
  Image gray(image.width, image.height, 1);
  for (std::size_t i = 0; i < gray.pixels.size(); ++i) gray.pixels[i] = image.pixels[3 * i + 1];
  TagDetector detector(apparatus.board.family, 1);
  std::vector<DetectedTag> found = detector.detect(gray, whole(gray));
  for (const Tag& tag : apparatus.board.tags) {
    const auto same = [&](const DetectedTag& detected) { return detected.id == tag.id; };
    const auto detected = std::ranges::find_if(found, same);
    ASSERT_NE(detected, found.end()) << "tag " << tag.id;
    for (std::size_t i = 0; i < 4; ++i) {
      const Eigen::Vector2d expected =
          project(apparatus.camera, SyntheticSettings().camera_from_board * tag.corners_m[i]);
      EXPECT_LT((detected->corners_px[i] - expected).norm(), 1.5) << "tag " << tag.id;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(SyntheticOptics, EveryFamily, testing::ValuesIn(tag_family_names()),
                         [](const auto& tested) { return std::string(tested.param); });

std::string refusal_of(const Apparatus& apparatus) {
  try {
    SyntheticCamera(apparatus, {}, 1);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(SyntheticOptics, RefusesWhatItCanNotShow) {
  Apparatus apparatus = default_apparatus(640);
  apparatus.board.family = "tag36h12";
  EXPECT_NE(refusal_of(apparatus).find("tag36h11"), std::string::npos) << refusal_of(apparatus);

  apparatus = default_apparatus(640);
  apparatus.effector.tags[0].id = 587;
  EXPECT_NE(refusal_of(apparatus).find("0 to 586"), std::string::npos) << refusal_of(apparatus);

  apparatus = default_apparatus(640);
  for (Vector3d& corner : apparatus.board.tags[3].corners_m) corner.z() = 0.01;
  EXPECT_NE(refusal_of(apparatus).find("tag 3"), std::string::npos) << refusal_of(apparatus);

  apparatus = default_apparatus(640);
  apparatus.effector.size_m.x() = 0.07;  // the tip's tag hangs in the air
  EXPECT_NE(refusal_of(apparatus).find("tag 30"), std::string::npos) << refusal_of(apparatus);
}

}  // namespace
}  // namespace heft
