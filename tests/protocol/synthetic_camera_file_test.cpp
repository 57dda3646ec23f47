// Files of the synthetic camera: their settings, and each mistake at its place.
#include <gtest/gtest.h>

#include <sstream>

#include "EditedFile.h"
#include "SourceFolder.h"
#include "protocol/readers/Files.h"
#include "tracking/synthetic/SyntheticCamera.h"

namespace heft {
namespace {

const std::string camera_file = R"(exposure_s = 0.01
blur_px = 1.5
readout_s = 0.02
vignetting = 0.5
light = 0.4
gamma = 2.2
noise_levels = 8
shadow = 0.4
glare = 0.25
film_curve = 0.75
s_curve = 0.6
mosaic = true
sharpening = 1.25
jpeg_quality = 85
auto_gain = 0.21
auto_white_balance = 0.11
flicker = 0.12
breathing = 0.004
last_picture = 0.31
repeated = 0.13
dropped = 0.14
board_tag_scale = 1.003
effector_tag_scale = 0.998
focal_length_scale = 0.995
ink_spread_m = 0.0001
hand = false
)";

TEST(SyntheticCameraFile, SetsEveryImperfection) {
  const SyntheticSettings settings = parse_synthetic_camera(camera_file, "x.toml");
  EXPECT_EQ(settings.optics.exposure_s, 0.01);
  EXPECT_EQ(settings.optics.readout_s, 0.02);
  EXPECT_EQ(settings.optics.blur_px, 1.5);
  EXPECT_EQ(settings.optics.vignetting, 0.5);
  EXPECT_EQ(settings.optics.exposure, 0.4);
  EXPECT_EQ(settings.optics.gamma, 2.2);
  EXPECT_EQ(settings.optics.noise, 8);
  EXPECT_EQ(settings.optics.shadow, 0.4);
  EXPECT_EQ(settings.optics.glare, 0.25);
  EXPECT_EQ(settings.optics.film_curve, 0.75);
  EXPECT_EQ(settings.optics.s_curve, 0.6);
  EXPECT_TRUE(settings.optics.mosaic);
  EXPECT_EQ(settings.optics.sharpening, 1.25);
  EXPECT_EQ(settings.optics.jpeg_quality, 85);
  EXPECT_EQ(settings.optics.auto_gain, 0.21);
  EXPECT_EQ(settings.optics.auto_white_balance, 0.11);
  EXPECT_EQ(settings.optics.flicker, 0.12);
  EXPECT_EQ(settings.optics.breathing, 0.004);
  EXPECT_EQ(settings.optics.last_picture, 0.31);
  EXPECT_EQ(settings.optics.repeated, 0.13);
  EXPECT_EQ(settings.optics.dropped, 0.14);
  EXPECT_EQ(settings.files.board_tag_scale, 1.003);
  EXPECT_EQ(settings.files.effector_tag_scale, 0.998);
  EXPECT_EQ(settings.files.focal_length_scale, 0.995);
  EXPECT_EQ(settings.files.ink_m, 0.0001);
  EXPECT_FALSE(settings.hand);
}

// The shipped file documents the defaults.
TEST(SyntheticCameraFile, ShippedFileHasTheDefaults) {
  const std::string shipped =
      content_of(source_folder() + "/protocols/apparatus/synthetic_camera.toml");
  EXPECT_EQ(recognized_kind(shipped, "x.toml"), FileKind::synthetic_camera);
  const SyntheticSettings usual;
  for (const std::string& text : {shipped, std::string()}) {
    const SyntheticSettings settings = parse_synthetic_camera(text, "x.toml");
    EXPECT_EQ(settings.optics.exposure_s, usual.optics.exposure_s);
    EXPECT_EQ(settings.optics.readout_s, usual.optics.readout_s);
    EXPECT_EQ(settings.optics.blur_px, usual.optics.blur_px);
    EXPECT_EQ(settings.optics.vignetting, usual.optics.vignetting);
    EXPECT_EQ(settings.optics.exposure, usual.optics.exposure);
    EXPECT_EQ(settings.optics.gamma, usual.optics.gamma);
    EXPECT_EQ(settings.optics.noise, usual.optics.noise);
    EXPECT_EQ(settings.optics.shadow, usual.optics.shadow);
    EXPECT_EQ(settings.optics.glare, usual.optics.glare);
    EXPECT_EQ(settings.optics.film_curve, usual.optics.film_curve);
    EXPECT_EQ(settings.optics.s_curve, usual.optics.s_curve);
    EXPECT_EQ(settings.optics.mosaic, usual.optics.mosaic);
    EXPECT_EQ(settings.optics.sharpening, usual.optics.sharpening);
    EXPECT_EQ(settings.optics.jpeg_quality, usual.optics.jpeg_quality);
    EXPECT_EQ(settings.optics.auto_gain, usual.optics.auto_gain);
    EXPECT_EQ(settings.optics.auto_white_balance, usual.optics.auto_white_balance);
    EXPECT_EQ(settings.optics.flicker, usual.optics.flicker);
    EXPECT_EQ(settings.optics.breathing, usual.optics.breathing);
    EXPECT_EQ(settings.optics.last_picture, usual.optics.last_picture);
    EXPECT_EQ(settings.optics.repeated, usual.optics.repeated);
    EXPECT_EQ(settings.optics.dropped, usual.optics.dropped);
    EXPECT_EQ(settings.files.board_tag_scale, usual.files.board_tag_scale);
    EXPECT_EQ(settings.files.effector_tag_scale, usual.files.effector_tag_scale);
    EXPECT_EQ(settings.files.focal_length_scale, usual.files.focal_length_scale);
    EXPECT_EQ(settings.hand, usual.hand);
  }
  for (const char* key : {"exposure_s",
                          "readout_s",
                          "blur_px",
                          "vignetting",
                          "light",
                          "gamma",
                          "noise_levels",
                          "shadow",
                          "glare",
                          "film_curve",
                          "s_curve",
                          "mosaic",
                          "sharpening",
                          "jpeg_quality",
                          "auto_gain",
                          "auto_white_balance",
                          "flicker",
                          "breathing",
                          "last_picture",
                          "repeated",
                          "dropped",
                          "board_tag_scale",
                          "effector_tag_scale",
                          "focal_length_scale",
                          "ink_spread_m",
                          "hand"})
    EXPECT_NE(shipped.find(std::string(key) + " = "), std::string::npos) << key;
}

// Each key is sufficient to recognize a file of a synthetic camera.
TEST(SyntheticCameraFile, IsRecognizedByEachOfItsKeys) {
  std::istringstream lines(camera_file);
  for (std::string line; std::getline(lines, line);)
    EXPECT_EQ(recognized_kind(line, "x.toml"), FileKind::synthetic_camera) << line;
}

TEST(SyntheticCameraFile, DescriptionNamesUnusualValues) {
  EXPECT_EQ(described(SyntheticSettings()), "exposure 4 ms, blur 0.6 px, noise 3 levels, sRGB");
  EXPECT_EQ(described(parse_synthetic_camera(camera_file, "x.toml")),
            "exposure 10 ms, read-out 20 ms, blur 1.5 px, noise 8 levels, gamma 2.2, light 0.4, "
            "shadow 0.4, glare 0.25, film curve 0.75, S-curve 0.6, mosaic, sharpening 1.25, JPEG "
            "85, automatic gain 0.21, automatic white balance 0.11, flicker 0.12, focus breathing "
            "0.004, of the last picture 0.31, repeated 0.13, dropped 0.14, board's tags by 1.003, "
            "effector's tags by 0.998, focal length by 0.995, ink spread in mm 0.1");
}

class BrokenSyntheticCamera : public testing::TestWithParam<Broken> {};

TEST_P(BrokenSyntheticCamera, IsOneMistakeAtItsPlace) {
  expect_broken(camera_file, GetParam(),
                [](auto& text) { parse_synthetic_camera(text, "x.toml"); });
}

const Broken broken_cameras[] = {
    {"unknown_key", {"noise_levels", "^noise_level"}, {"\"noise_levels\"?"}},
    {"key_without_unit", {"blur_px", "^blur"}, {"\"blur_px\"?"}},
    {"open_for_too_long", {"= 0.01\n", "= ^0.06\n"}, {"exposure_s is 0.06", "at most 0.05"}},
    {"negative_blur", {"= 1.5", "= ^-1"}, {"blur_px is -1", "at least 0"}},
    {"black_corners", {"= 0.5", "= ^1"}, {"vignetting is 1", "below 1"}},
    {"no_light", {"= 0.4", "= ^0"}, {"light is 0", "above 0"}},
    {"slow_rows", {"= 0.02\n", "= ^0.06\n"}, {"readout_s is 0.06", "at most 0.05"}},
    {"gamma_of_nothing", {"= 2.2", "= ^0"}, {"gamma is 0", "at least 1 and at most 3"}},
    {"noise_as_text", {"= 8\n", "= ^\"much\"\n"}, {"noise_levels", "a number"}},
    {"more_than_all_light_missing",
     {"= 0.4\nglare", "= ^1.5\nglare"},
     {"shadow is 1.5", "at most 1"}},
    {"glare_of_darkness", {"= 0.25", "= ^-0.25"}, {"glare is -0.25", "at least 0"}},
    {"all_film_and_more", {"= 0.75", "= ^2"}, {"film_curve is 2", "at most 1"}},
    {"film_without_curve", {"film_curve", "^film"}, {"unknown key", "\"film_curve\"?"}},
    {"s_curve_as_truth", {"= 0.6", "= ^true"}, {"s_curve", "a number"}},
    {"mosaic_as_number", {"true", "^4"}, {"mosaic", "true or false"}},
    {"only_the_last_picture", {"= 0.31", "= ^1"}, {"last_picture is 1", "at most 0.9"}},
    {"oversharpened", {"= 1.25", "= ^6"}, {"sharpening is 6", "at most 5"}},
    {"jpeg_of_no_quality", {"= 85", "= ^0"}, {"jpeg_quality is 0", "1"}},
    {"jpeg_of_half_a_quality", {"= 85", "= ^84.5"}, {"jpeg_quality", "whole number"}},
    {"another_board", {"= 1.003", "= ^2"}, {"board_tag_scale is 2", "at most 1.1"}},
    {"effector_in_percent", {"= 0.998", "= ^99.8"}, {"effector_tag_scale is 99.8", "at most 1.1"}},
    {"no_lens", {"= 0.995", "= ^0"}, {"focal_length_scale is 0", "at least 0.9"}},
    {"hand_as_number", {"false", "^1"}, {"true or false"}},
};
INSTANTIATE_TEST_SUITE_P(SyntheticCameraFile, BrokenSyntheticCamera,
                         testing::ValuesIn(broken_cameras), name_of_broken);

}  // namespace
}  // namespace heft
