#include "view/ArView.h"

#include <fmt/format.h>

#include <algorithm>
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
#include "view/text/Letters.h"

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

// Lines of text in a strip above the scene.
class Captions {
 public:
  explicit Captions(int n_lines)
      : n_lines_(n_lines), letters_(n_lines > 0 ? make_letters("en") : nullptr) {}

  int height_px() const { return n_lines_ * line_px; }

  // The scene with the lines above it.
  const Image& above(const Image& scene, const std::vector<std::string>& lines) {
    if (n_lines_ == 0) return scene;
    image_ = Image(scene.width, scene.height + height_px(), 3);
    const auto n_strip =
        static_cast<std::ptrdiff_t>(height_px()) * static_cast<std::ptrdiff_t>(image_.row_bytes());
    std::fill_n(image_.pixels.begin(), n_strip, white);
    std::ranges::copy(scene.pixels, image_.pixels.begin() + n_strip);
    for (int i = 0; i < std::min(n_lines_, static_cast<int>(lines.size())); ++i)
      write(letters_->ink({lines[static_cast<std::size_t>(i)], letter_px}), i * line_px + 2);
    return image_;
  }

 private:
  static constexpr int line_px = 20, margin_px = 8;
  static constexpr float letter_px = 15;
  static constexpr std::uint8_t white = 255;

  // What extends beyond the image is cut off.
  void write(const Ink& ink, int top) {
    for (int y = 0; y < ink.height; ++y)
      for (int x = 0; x < ink.width; ++x) {
        const int to_x = margin_px + ink.left + x, to_y = top + ink.top + y;
        if (to_x < 0 || to_x >= image_.width || to_y < 0 || to_y >= image_.height) continue;
        const auto i = static_cast<std::size_t>(y * ink.width + x);
        const auto to = static_cast<std::size_t>(to_y) * image_.row_bytes() +
                        static_cast<std::size_t>(3 * to_x);
        std::fill_n(image_.pixels.begin() + static_cast<std::ptrdiff_t>(to), 3,
                    static_cast<std::uint8_t>(white - ink.coverage[i]));
      }
  }

  int n_lines_;
  std::unique_ptr<Letters> letters_;  // none without lines
  Image image_;
};

class VideoView final : public ArView {
 public:
  explicit VideoView(const ViewSetup& setup) : drawing_(setup), captions_(setup.n_captions) {
    const auto& [ending, codec, writer] = format_of(setup.file);
    if (std::filesystem::exists(setup.file))
      throw Error(
          fmt::format("{} already exists and would be overwritten; name another video, or "
                      "remove it first",
                      setup.file));
    create_file(setup.file, 0600);  // may show people's hands
    const Image& first = captions_.above(drawing_.draw({}), {});
    writer_ = codecs().writer(setup.file, writer, four_cc(codec), setup.rate_hz, first.width,
                              first.height);
    if (!writer_->isOpened())
      throw Error(
          fmt::format("cannot write the video {} ({} x {}, {:g} frames per second); check "
                      "that its folder exists and is writable",
                      setup.file, first.width, first.height, setup.rate_hz));
  }

  std::optional<double> present(const ViewFrame& shown, const ScreenState&) override {
    const Image& drawn = captions_.above(drawing_.draw(shown), shown.captions);
    // OpenCV has no read-only images, but the writer does not change this one.
    writer_->write(cv::Mat(drawn.height, drawn.width, CV_8UC3,
                           const_cast<std::uint8_t*>(drawn.pixels.data())));
    return {};
  }

  std::vector<Touch> wait(double) override { return {}; }

 private:
  SceneDrawing drawing_;
  Captions captions_;
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
