// A video file as a camera.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <opencv2/videoio.hpp>

#include "base/Error.h"
#include "tracking/CameraSources.h"
#include "tracking/ImageConversion.h"

namespace heft {

namespace {

class VideoFile : public Camera {
 public:
  explicit VideoFile(const std::string& path);

  std::optional<CameraPicture> next(double timeout_s) override;
  bool ended() const override { return !ahead_; }
  CameraMode mode() const override { return mode_; }
  bool is_live() const override { return false; }

 private:
  std::optional<CameraPicture> read();
  double time_of(std::int64_t number);

  cv::VideoCapture video_;
  CameraMode mode_;
  std::int64_t n_read_ = 0;
  double first_s_ = 0, last_s_ = 0;
  std::optional<CameraPicture> ahead_;  ///< read one ahead: that is how the end shows
};

VideoFile::VideoFile(const std::string& path) {
  if (!std::filesystem::exists(path)) throw Error(fmt::format("there is no video {}", path));
  // The decoders that come with OpenCV; with any other backend a name with % in it means a series.
  for (const int backend : {cv::CAP_FFMPEG, cv::CAP_OPENCV_MJPEG})
    if (!video_.isOpened()) video_.open(path, backend);
  if (video_.isOpened()) {
    mode_.rate_hz = video_.get(cv::CAP_PROP_FPS);
    ahead_ = read();
  }
  if (!ahead_)
    throw Error(
        fmt::format("{} can't be read as a video: it is damaged, empty, not readable for "
                    "you, or of a kind that OpenCV has no decoder for here; a Motion-JPEG "
                    ".avi can be read everywhere",
                    path));
  mode_.width_px = ahead_->image.width;
  mode_.height_px = ahead_->image.height;
}

// The file's own times where they go on; a picture at least, by the rate, where they don't.
double VideoFile::time_of(std::int64_t number) {
  const double rate_hz = mode_.rate_hz > 0 && std::isfinite(mode_.rate_hz) ? mode_.rate_hz : 30;
  const double own_s = video_.get(cv::CAP_PROP_POS_MSEC) / 1e3;
  if (number == 0) {
    first_s_ = std::isfinite(own_s) ? own_s : 0;
    return 0;
  }
  const double t_s = own_s - first_s_;
  return std::isfinite(t_s) && t_s > last_s_ ? t_s : last_s_ + 1 / rate_hz;
}

std::optional<CameraPicture> VideoFile::read() {
  cv::Mat picture;
  if (!video_.read(picture) || picture.empty()) return std::nullopt;
  const std::int64_t number = n_read_++;
  last_s_ = time_of(number);
  return CameraPicture{image_from(picture), last_s_, number, ""};
}

std::optional<CameraPicture> VideoFile::next(double) {
  std::optional<CameraPicture> given = std::move(ahead_);
  ahead_ = given ? read() : std::nullopt;
  return given;
}

}  // namespace

std::unique_ptr<Camera> open_video_file(const std::string& path, const CameraRequest&) {
  return std::make_unique<VideoFile>(path);
}

}  // namespace heft
