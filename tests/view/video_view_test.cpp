// The view that writes a video file, read back with OpenCV.
#include <gmock/gmock.h>

#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/videoio.hpp>

#include "base/Error.h"
#include "base/files/TextFile.h"
#include "record/temporary_folder.h"
#include "tracking/codecs/Codecs.h"
#include "view/ArView.h"
#include "view/Scenes.h"

namespace heft {
namespace {

using ::testing::HasSubstr;
using namespace heft::test;

constexpr int n_frames = 8;

ViewFrame shown_as_number(const ViewSetup& setup, int number) {
  ViewFrame shown = three_cubes(setup);
  shown.frame.clone = pointing_away(0.01 * number - 0.04, -0.05);
  return shown;
}

void write_video(const ViewSetup& setup) {
  const auto view = make_video_view(setup);
  for (int i = 0; i < n_frames; ++i) {
    EXPECT_EQ(view->present(shown_as_number(setup, i), ScreenState{}), std::nullopt);
    EXPECT_TRUE(view->wait(1).empty());
  }
}

double mean_difference(const cv::Mat& read, const Image& drawn) {
  cv::Mat expected(drawn.height, drawn.width, CV_8UC3);
  std::ranges::copy(drawn.pixels, expected.data);
  return cv::norm(read, expected, cv::NORM_L1) / static_cast<double>(drawn.pixels.size());
}

TEST(VideoView, VideoHasEveryDrawnFrame) {
  const TemporaryFolder folder;
  for (const char* name : {"session.mp4", "session.avi"}) {
    ViewSetup setup = setup_with(Intrinsics{});
    setup.file = folder.file(name);
    write_video(setup);
    const auto video = codecs().capture();
    ASSERT_TRUE(video->open(setup.file)) << name;
    EXPECT_DOUBLE_EQ(video->get(cv::CAP_PROP_FPS), setup.rate_hz) << name;
    SceneDrawing drawing(setup);
    cv::Mat read;
    for (int i = 0; i < n_frames; ++i) {
      ASSERT_TRUE(video->read(read)) << name << " " << i;
      const Image& drawn = drawing.draw(shown_as_number(setup, i));
      ASSERT_EQ(read.size(), cv::Size(drawn.width, drawn.height));
      EXPECT_LT(mean_difference(read, drawn), 3) << name << " " << i;
    }
    EXPECT_FALSE(video->read(read)) << name;
  }
}

TEST(VideoView, CaptionsOfAReplayAreWrittenAboveTheScene) {
  const TemporaryFolder folder;
  ViewSetup setup = setup_with(Intrinsics{});
  setup.file = folder.file("replay.avi");
  setup.n_captions = 2;
  ViewFrame shown = shown_as_number(setup, 1);
  shown.captions = {"trial 1: sorting", "answer: none yet", "one too many"};
  make_video_view(setup)->present(shown, {});
  const auto video = codecs().capture();
  ASSERT_TRUE(video->open(setup.file));
  cv::Mat read;
  ASSERT_TRUE(video->read(read));
  SceneDrawing drawing(setup);
  const Image& drawn = drawing.draw(shown);
  const int strip_px = read.rows - drawn.height;
  ASSERT_EQ(strip_px % 2, 0);
  const int line_px = strip_px / 2;
  EXPECT_LT(mean_difference(read.rowRange(strip_px, read.rows).clone(), drawn), 3);
  for (int line = 0; line < 2; ++line) {
    const cv::Mat strip = read.rowRange(line * line_px, (line + 1) * line_px);
    const double white = cv::mean(strip.colRange(read.cols / 2, read.cols))[0];
    EXPECT_GT(white, 250) << "the lines are short";
    EXPECT_LT(cv::mean(strip.colRange(0, 120))[0], 235) << "ink of line " << line;
  }
}

void expect_refused(const std::string& file, const char* why) {
  ViewSetup setup = setup_with(std::nullopt);
  setup.file = file;
  try {
    make_video_view(setup);
    FAIL() << file << " was accepted";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr(why));
    EXPECT_THAT(error.what(), HasSubstr(file));
  }
}

TEST(VideoView, ExistingAndUnwritableFilesAreRefused) {
  const TemporaryFolder folder;
  const std::string taken = folder.file("taken.mp4");
  std::ofstream(taken) << "precious";
  expect_refused(taken, "already exists");
  EXPECT_EQ(read_text_file(taken), "precious");
  expect_refused(folder.file("session.mov"), ".mp4 or .avi");
  expect_refused(folder.file("session"), ".mp4 or .avi");
  expect_refused(folder.file("nowhere/session.mp4"), "cannot write");
}

TEST(VideoView, TableEntryHasFileAndNoScreen) {
  EXPECT_TRUE(view_named("video").has_file);
  EXPECT_FALSE(view_named("video").has_screen);
}

}  // namespace
}  // namespace heft
