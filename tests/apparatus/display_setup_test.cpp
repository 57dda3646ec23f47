// What of the display goes into a setup.
#include <gmock/gmock.h>

#include "apparatus/SessionSetup.h"
#include "base/Error.h"

namespace heft {
namespace {

const DisplayFacts lab{1, "DELL", 1024, 600, 60, 1.5};

TEST(DisplaySetup, HasWhatTheWindowTells) {
  const SessionConfig setup = with_display({}, lab);
  EXPECT_EQ(setup.display, "1 DELL");
  EXPECT_EQ(setup.display_w_px, 1024);
  EXPECT_EQ(setup.display_h_px, 600);
  EXPECT_EQ(setup.refresh_hz, 60);
  EXPECT_EQ(setup.display_scale, 1.5);
  EXPECT_EQ(setup.window, "full screen");
  EXPECT_FALSE(setup.display_w_mm) << "nobody measured it";
  EXPECT_EQ(display_number(setup), 1) << "a resumed session takes the same";
  EXPECT_EQ(with_display({}, std::nullopt), SessionConfig{});
}

TEST(DisplaySetup, AnotherDisplayThanTheMeasuredOneIsRefused) {
  SessionConfig measured;
  measured.display_file = "/lab/display.toml";
  measured.display_w_px = 1920;
  measured.display_h_px = 1080;
  measured.display_w_mm = 500;
  try {
    with_display(measured, lab);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.exit_code(), ExitCode::invalid_file);
    EXPECT_THAT(error.what(), testing::HasSubstr("/lab/display.toml"));
    EXPECT_THAT(error.what(), testing::HasSubstr("heft calibrate display"));
  }
  measured.display_w_px = 1024;
  measured.display_h_px = 600;
  EXPECT_EQ(with_display(measured, lab).display_w_mm, 500);
}

TEST(DisplaySetup, ADisplayIsNamedByItsNumber) {
  SessionConfig setup;
  EXPECT_EQ(display_number(setup), 0);
  for (const char* wrong : {"left", "-1", "1x", "999"}) {
    setup.display = wrong;
    EXPECT_THROW(display_number(setup), Error) << wrong;
  }
}

}  // namespace
}  // namespace heft
