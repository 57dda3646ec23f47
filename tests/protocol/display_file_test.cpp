// The file of a measured display.
#include <gmock/gmock.h>

#include "base/Error.h"
#include "experiment/Stage.h"
#include "protocol/readers/Files.h"

namespace heft {
namespace {

TEST(DisplayFile, IsReadBackAsWritten) {
  const DisplayMeasures read = parse_display(to_toml({1024, 600, 154.25, 90.5, 450}), "d.toml");
  EXPECT_EQ(read.w_px, 1024);
  EXPECT_EQ(read.h_px, 600);
  EXPECT_NEAR(read.w_mm, 154.25, 0.1);
  EXPECT_NEAR(read.h_mm, 90.5, 0.1);
  EXPECT_EQ(read.eye_distance_mm, 450);
  EXPECT_TRUE(read.latency_ms.empty());
  const std::map<std::string, double> latency_ms{
      {"light_ms", 23.5}, {"picture_ms", 51}, {"picture_p5_ms", 44}, {"picture_p95_ms", 58.5}};
  const std::string text = to_toml({1024, 600, 154.25, 90.5, 450, latency_ms});
  EXPECT_EQ(parse_display(text, "d.toml").latency_ms, latency_ms);
  EXPECT_EQ(recognized_kind(text, "d.toml"), FileKind::display);
}

TEST(DisplayFile, MissingAndInvalidKeysAreReportedWithTheirLines) {
  const std::string text = "width_px = 1024\nheight_px = 600\nwidth_mm = 0\nheight_mm = 90\n";
  try {
    parse_display(text, "d.toml");
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("d.toml:3:"));
    EXPECT_THAT(error.what(), testing::HasSubstr("eye_distance_mm"));
  }
  const std::string latency = "[latency]\nlight_ms = -1\npicture_ms = 40\n";
  try {
    parse_display(text + "eye_distance_mm = 450\n" + latency, "d.toml");
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("d.toml:7:"));
    EXPECT_THAT(error.what(), testing::HasSubstr("picture_p95_ms"));
  }
}

}  // namespace
}  // namespace heft
