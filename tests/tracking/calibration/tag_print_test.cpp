// Boards whose tags do not fit their distances, or whose ink spread.
#include <gtest/gtest.h>

#include <functional>

#include "tracking/calibration/CalibrationViews.h"
#include "tracking/calibration/CameraCalibration.h"

namespace heft {
namespace {

constexpr std::uint64_t seed = 20261127;

CameraCalibration calibrated(const std::function<void(SyntheticSettings&)>& change) {
  const Apparatus apparatus = default_apparatus(640);
  RandomStream random(seed, "printed boards");
  std::vector<Image> pictures;
  std::vector<std::string> names;
  for (std::uint64_t i = 0; i < 12; ++i) {
    SyntheticSettings settings;
    settings.camera_from_board = view_of_board(random, 1);
    settings.hand = false;
    change(settings);
    SyntheticCamera camera({apparatus.camera, apparatus.board, {}}, settings, seed);
    pictures.push_back(camera.picture(out_of_view, 0, i));
    names.push_back("view " + std::to_string(i));
  }
  return calibrate_camera(apparatus.board, pictures, names);
}

bool blames_tags(const CameraCalibration& found) {
  for (const std::string& doubt : doubts(found))
    if (doubt.find("multiply tag_m") != std::string::npos) return true;
  return false;
}

TEST(TagPrint, FindsTagsThatDoNotFitTheirDistances) {
  const Apparatus apparatus = default_apparatus(640);
  for (const double scale : {0.99, 1.01}) {
    const auto found = calibrated([&](SyntheticSettings& to) { to.files.board_tag_scale = scale; });
    EXPECT_NEAR(found.tags.excess, scale - 1, 0.0005) << "seed " << seed;
    EXPECT_TRUE(blames_tags(found)) << summary(found);
    EXPECT_FALSE(found.tags.has_spread());
    EXPECT_LT(ray_errors(found.camera, apparatus.camera).p95_px, 0.2);
  }
}

// Tone curves make all edges look displaced, also those of cells.
TEST(TagPrint, IsDistinguishedFromToneCurves) {
  for (const auto& change : std::vector<std::function<void(Optics&)>>{
           [](Optics&) {}, [](Optics& to) { to.gamma = 1.8; }, [](Optics& to) { to.s_curve = 1; },
           [](Optics& to) { to.film_curve = 1; }, [](Optics& to) { to.sharpening = 0.7; },
           [](Optics& to) { to.noise = 8; }}) {
    const auto found = calibrated([&](SyntheticSettings& to) { change(to.optics); });
    EXPECT_NEAR(found.tags.excess, 0, 0.0015) << "seed " << seed;
    EXPECT_FALSE(blames_tags(found)) << summary(found);
    EXPECT_EQ(summary(found).find("ink"), std::string::npos) << summary(found);
  }
}

TEST(TagPrint, FindsTagsThatDoNotFitUnderAToneCurve) {
  const auto found = calibrated([](SyntheticSettings& to) {
    to.files.board_tag_scale = 1.01;
    to.optics.film_curve = 1;
  });
  EXPECT_NEAR(found.tags.excess, 0.01, 0.002) << "seed " << seed;
  EXPECT_TRUE(blames_tags(found)) << summary(found);
}

TEST(TagPrint, NamesInkAsThePrints) {
  const auto found = calibrated([](SyntheticSettings& to) { to.files.ink_m = 0.0001; });
  EXPECT_NEAR(found.tags.ink_m, 0.0001, 0.00001) << "seed " << seed;
  EXPECT_FALSE(blames_tags(found)) << summary(found);
  EXPECT_NE(summary(found).find("the print, not the camera"), std::string::npos) << summary(found);
}

TEST(TagPrint, IsUnknownFromFewPictures) {
  const Apparatus apparatus = default_apparatus(640);
  const auto views = board_views(apparatus, 2, 1, seed);
  const TagPrint print = print_of_tags(apparatus.board, apparatus.camera, views.images);
  EXPECT_EQ(print.excess, 0);
  EXPECT_FALSE(print.is_off());
  EXPECT_FALSE(print.has_spread());
}

}  // namespace
}  // namespace heft
