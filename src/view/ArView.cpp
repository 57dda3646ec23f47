#include "view/ArView.h"

#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <opencv2/videoio.hpp>
#include <string_view>

#include "base/Error.h"
#include "base/Names.h"
#include "base/Program.h"
#include "base/files/TextFile.h"
#include "tracking/codecs/Codecs.h"
#include "view/Window.h"
#include "view/scene/SceneDrawing.h"

namespace heft {

namespace {
struct Format {
  std::string_view ending;
  std::array<char, 4> codec;
  cv::VideoCaptureAPIs writer;  // otherwise OpenCV tries all of them, with messages on stderr
};

constexpr std::array formats{Format{".mp4", {'m', 'p', '4', 'v'}, cv::CAP_FFMPEG},
                             Format{".avi", {'M', 'J', 'P', 'G'}, cv::CAP_OPENCV_MJPEG}};

const Format& format_of(const std::string& file) {
  const std::string ending = std::filesystem::path(file).extension().string();
  for (const Format& format : formats)
    if (format.ending == ending) return format;
  throw Error(fmt::format("the video \"{}\" has no known format: its name must end in .mp4 or "
                          ".avi, as in video:session.mp4",
                          file),
              ExitCode::usage);
}

class VideoView final : public ArView {
 public:
  explicit VideoView(const ViewSetup& setup) : drawing_(setup) {
    const auto& [ending, codec, writer] = format_of(setup.file);
    if (std::filesystem::exists(setup.file))
      throw Error(
          fmt::format("{} already exists and would be overwritten; name another video, or "
                      "remove it first",
                      setup.file));
    create_file(setup.file, 0600);  // may show people's hands
    const Image& first = drawing_.draw({});
    writer_ = codecs().writer(setup.file, writer, four_cc(codec), setup.rate_hz, first.width,
                              first.height);
    if (!writer_->isOpened())
      throw Error(
          fmt::format("cannot write the video {} ({} x {}, {:g} frames per second); check "
                      "that its folder exists and is writable",
                      setup.file, first.width, first.height, setup.rate_hz));
  }

  std::optional<double> present(const ViewFrame& shown, const ScreenState&) override {
    const Image& drawn = drawing_.draw(shown);
    // OpenCV has no read-only images, but the writer does not change this one.
    writer_->write(cv::Mat(drawn.height, drawn.width, CV_8UC3,
                           const_cast<std::uint8_t*>(drawn.pixels.data())));
    return {};
  }

  std::vector<Touch> wait(double) override { return {}; }

 private:
  SceneDrawing drawing_;
  std::unique_ptr<cv::VideoWriter> writer_;  // completes the file when destroyed
};
}  // namespace

std::unique_ptr<ArView> make_video_view(const ViewSetup& setup) {
  return std::make_unique<VideoView>(setup);
}

namespace {
// Displays nothing: for simulated responders and machines without a display.
class HeadlessView final : public ArView {
 public:
  explicit HeadlessView(const ViewSetup&) {}
  std::optional<double> present(const ViewFrame&, const ScreenState&) override { return {}; }
  std::vector<Touch> wait(double) override { return {}; }
};

std::unique_ptr<ArView> make_headless(const ViewSetup& setup) {
  return std::make_unique<HeadlessView>(setup);
}

std::unique_ptr<ArView> make_window(const ViewSetup& setup) {
  return window_module().make(setup);
}

constexpr std::array table{
    ViewEntry{"headless", "no display; for simulated responders", false, false, make_headless},
    ViewEntry{"window", "the participant's screen, for touch, mouse and keys", true, false,
              make_window},
    ViewEntry{"video", "writes the displayed frames into a video file: video:session.mp4", false,
              true, make_video_view}};
}  // namespace

std::span<const ViewEntry> views() {
  return table;
}

const ViewEntry& view_named(std::string_view name) {
  return entry_named("view", name, views());
}

const WindowModule& window_module() {
  static const auto& module = *static_cast<const WindowModule*>(
      from_module("heft-window.so", "heft_window", "finds displays and shows windows"));
  return module;
}

}  // namespace heft
