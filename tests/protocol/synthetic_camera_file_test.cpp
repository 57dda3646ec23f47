// Files of the synthetic camera: what they set, and every mistake they can have.
#include <gtest/gtest.h>

#include "EditedFile.h"
#include "protocol/Files.h"
#include "tracking/SyntheticCamera.h"

namespace heft {
namespace {

const std::string everything = R"(exposure_s = 0.01
blur_px = 1.5
readout_s = 0.02
vignetting = 0.5
light = 0.4
gamma = 2.2
noise_levels = 8
hand = false
)";

TEST(SyntheticCameraFile, SetsEveryImperfection) {
  const SyntheticSettings settings = parse_synthetic_camera(everything, "x.toml");
  EXPECT_EQ(settings.optics.exposure_s, 0.01);
  EXPECT_EQ(settings.optics.readout_s, 0.02);
  EXPECT_EQ(settings.optics.blur_px, 1.5);
  EXPECT_EQ(settings.optics.vignetting, 0.5);
  EXPECT_EQ(settings.optics.exposure, 0.4);
  EXPECT_EQ(settings.optics.gamma, 2.2);
  EXPECT_EQ(settings.optics.noise, 8);
  EXPECT_FALSE(settings.hand);
}

// The shipped file explains the defaults, so it must be them.
TEST(SyntheticCameraFile, ShippedIsTheUsualCamera) {
  const std::string shipped =
      content_of(std::string(HEFT_SOURCE_DIR) + "/protocols/apparatus/synthetic_camera.toml");
  EXPECT_EQ(recognized_kind(shipped, "x.toml"), FileKind::synthetic_camera);
  const SyntheticSettings usual;
  for (const std::string& text : {shipped, std::string()}) {
    const SyntheticSettings settings = parse_synthetic_camera(text, "x.toml");
    EXPECT_EQ(settings.optics.exposure_s, usual.optics.exposure_s);
    EXPECT_EQ(settings.optics.blur_px, usual.optics.blur_px);
    EXPECT_EQ(settings.optics.vignetting, usual.optics.vignetting);
    EXPECT_EQ(settings.optics.exposure, usual.optics.exposure);
    EXPECT_EQ(settings.optics.gamma, usual.optics.gamma);
    EXPECT_EQ(settings.optics.noise, usual.optics.noise);
    EXPECT_EQ(settings.hand, usual.hand);
  }
  for (const char* key : {"exposure_s", "readout_s", "blur_px", "vignetting", "light", "gamma",
                          "noise_levels", "hand"})
    EXPECT_NE(shipped.find(std::string(key) + " = "), std::string::npos) << key;
}

class BrokenSyntheticCamera : public testing::TestWithParam<Broken> {};

TEST_P(BrokenSyntheticCamera, IsOneMistakeAtItsPlace) {
  expect_broken(everything, GetParam(), [](auto& text) { parse_synthetic_camera(text, "x.toml"); });
}

const Broken broken[] = {
    {"unknown_key", {"noise_levels", "^noise_level"}, {"\"noise_levels\"?"}},
    {"key_without_unit", {"blur_px", "^blur"}, {"\"blur_px\"?"}},
    {"open_for_too_long", {"= 0.01\n", "= ^0.06\n"}, {"exposure_s is 0.06", "at most 0.05"}},
    {"negative_blur", {"= 1.5", "= ^-1"}, {"blur_px is -1", "at least 0"}},
    {"black_corners", {"= 0.5", "= ^1"}, {"vignetting is 1", "below 1"}},
    {"no_light", {"= 0.4", "= ^0"}, {"light is 0", "above 0"}},
    {"slow_rows", {"= 0.02\n", "= ^0.06\n"}, {"readout_s is 0.06", "at most 0.05"}},
    {"gamma_of_nothing", {"= 2.2", "= ^0"}, {"gamma is 0", "at least 1 and at most 3"}},
    {"noise_as_text", {"= 8", "= ^\"much\""}, {"noise_levels", "a number"}},
    {"hand_as_number", {"false", "^1"}, {"true or false"}},
};
INSTANTIATE_TEST_SUITE_P(SyntheticCameraFile, BrokenSyntheticCamera, testing::ValuesIn(broken),
                         name_of_broken);

}  // namespace
}  // namespace heft
