// A folder of pictures and a video file as cameras.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <opencv2/videoio.hpp>
#include <utility>

#include "base/Error.h"
#include "base/files/Printable.h"
#include "base/files/TextFile.h"
#include "tracking/camera/Camera.h"
#include "tracking/camera/ImageConversion.h"
#include "tracking/camera/ImageFile.h"
#include "tracking/codecs/Codecs.h"

namespace heft {

namespace {
namespace fs = std::filesystem;

constexpr double rate_without_times_hz = 30;

// A sort key in which numbers compare by value, frame_2 before frame_10: each number is preceded by
// its count of digits.
std::string natural_key(std::string_view name) {
  constexpr std::string_view digits = "0123456789";
  std::string key;
  while (!name.empty()) {
    const auto n = std::min(name.find_first_not_of(digits), name.size());
    const auto zeros = std::min(name.find_first_not_of('0'), n);
    if (n > 0) key.append(1, '0').append(1, static_cast<char>(n - zeros + 1));
    key += n > 0 ? name.substr(zeros, n - zeros) : name.substr(0, 1);
    name.remove_prefix(std::max<std::size_t>(n, 1));
  }
  return key;
}

std::vector<std::string> picture_names(const std::string& folder) {
  std::error_code error;
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
    if (is_image_file(entry.path().string())) {
      if (!entry.is_regular_file())
        throw Error(
            fmt::format("{} is no file (a pipe, a device, or a link to nothing); remove it "
                        "from the pictures",
                        entry.path().string()));
      names.push_back(entry.path().filename().string());
    }
  if (error)
    throw Error(
        fmt::format("{} cannot be read as a folder of pictures: {}", folder, error.message()));
  if (names.empty())
    throw Error(fmt::format("{} holds no pictures (png, jpg, bmp, pgm, ppm, tif)", folder));
  std::ranges::sort(names, {}, [](const std::string& name) {
    return std::pair(natural_key(name), name);  // img_1 and img_01
  });
  return names;
}

InvalidFile wrong_time(const std::string& file, std::size_t line, const std::string& what) {
  std::vector<Mistake> mistakes(1);
  mistakes[0].place = {file, static_cast<int>(line), 1};
  mistakes[0].message = what;
  return InvalidFile(std::move(mistakes));
}

constexpr double latest_s = 1e12;

// Times of pictures by file name.
std::map<std::string, double, std::less<>> read_times(const std::string& file) {
  const std::string text = read_text_file(file);
  const std::vector<std::string_view> lines = lines_of(text);
  if (lines.empty() || cells_of(lines[0]) != std::vector<std::string_view>{"frame", "t_s"})
    throw wrong_time(file, 1, "the first line must be frame,t_s");
  std::map<std::string, double, std::less<>> times;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const std::vector<std::string_view> cells = cells_of(lines[i]);
    if (cells.size() == 1 && cells[0].empty()) continue;
    const auto t_s = cells.size() == 2 ? number_in(cells[1]) : std::nullopt;
    if (!t_s || std::abs(*t_s) > latest_s)
      throw wrong_time(file, i + 1,
                       fmt::format("expected a file's name and its time in seconds, "
                                   "as in frame_1.png,0.033; found \"{}\"",
                                   printable(std::string(lines[i]))));
    if (!times.emplace(cells[0], *t_s).second)
      throw wrong_time(file, i + 1,
                       fmt::format("{} already has a time", printable(std::string(cells[0]))));
  }
  return times;
}

std::vector<double> times_of(const std::string& folder, const std::vector<std::string>& names) {
  const std::string file = (fs::path(folder) / "times.csv").string();
  std::vector<double> times;
  if (!fs::exists(file)) {
    for (std::size_t i = 0; i < names.size(); ++i)
      times.push_back(static_cast<double>(i) / rate_without_times_hz);
    return times;
  }
  auto by_name = read_times(file);
  for (const std::string& name : names) {
    const auto found = by_name.find(name);
    if (found == by_name.end())
      throw Error(
          fmt::format("{} has no line for {}; add its time, or remove the picture", file, name));
    if (!times.empty() && found->second <= times.back())
      throw Error(
          fmt::format("{}: times must increase from picture to picture in the order of "
                      "their names, but {} at {} s comes after {} s",
                      file, name, found->second, times.back()));
    times.push_back(found->second);
    by_name.erase(found);
  }
  if (!by_name.empty())
    throw Error(
        fmt::format("{} has a time for {}, but {} has no such picture; restore it, or "
                    "remove its line",
                    file, by_name.begin()->first, folder));
  return times;
}

class PictureFolder : public Camera {
 public:
  explicit PictureFolder(const std::string& folder)
      : folder_(folder), names_(picture_names(folder)), times_s_(times_of(folder, names_)) {
    first_ = read_image(path_of(0));
  }

  std::optional<CameraPicture> next(double) override {
    if (ended()) return std::nullopt;
    const std::size_t i = next_++;
    const double t_s = times_s_[i] - times_s_[0];
    return CameraPicture{i == 0 ? first_ : read(i, t_s), t_s, static_cast<std::int64_t>(i),
                         names_[i]};
  }
  bool ended() const override { return next_ == names_.size(); }
  bool is_live() const override { return false; }

  CameraMode mode() const override {
    const double duration_s = times_s_.back() - times_s_.front();
    const double rate_hz = duration_s > 0 ? static_cast<double>(names_.size() - 1) / duration_s : 0;
    return {first_.width, first_.height, rate_hz, "", {}, {}};
  }

 private:
  Image read(std::size_t i, double t_s) const {
    Image image;
    try {
      image = read_image(path_of(i));
    } catch (const Error& error) {
      throw DamagedPicture(error.what(), names_[i], t_s);
    }
    require_same_size(image, i);
    return image;
  }
  void require_same_size(const Image& image, std::size_t i) const {
    if (image.width == first_.width && image.height == first_.height) return;
    throw Error(fmt::format(
        "{} is {} x {} pixels, but the first picture of its folder, {}, has {} x {}; expected "
        "pictures of one size",
        path_of(i), image.width, image.height, names_[0], first_.width, first_.height));
  }
  std::string path_of(std::size_t i) const { return (fs::path(folder_) / names_[i]).string(); }

  std::string folder_;
  std::vector<std::string> names_;
  std::vector<double> times_s_;
  Image first_;
  std::size_t next_ = 0;
};
}  // namespace

std::unique_ptr<Camera> open_picture_folder(const std::string& path, const CameraRequest&) {
  return std::make_unique<PictureFolder>(path);
}

namespace {

class VideoFile : public Camera {
 public:
  explicit VideoFile(const std::string& path);

  std::optional<CameraPicture> next(double timeout_s) override;
  bool ended() const override { return !ahead_; }
  CameraMode mode() const override { return mode_; }
  bool is_live() const override { return false; }

 private:
  void refuse_absurd_size(const std::string& path) const;
  std::optional<CameraPicture> read();
  double time_of(std::int64_t number);

  std::unique_ptr<cv::VideoCapture> video_ = codecs().capture();
  CameraMode mode_;
  std::int64_t n_read_ = 0;
  double first_s_ = 0, last_s_ = 0;
  std::optional<CameraPicture> ahead_;  ///< read one ahead, to detect the end
};

VideoFile::VideoFile(const std::string& path) {
  if (!std::filesystem::exists(path)) throw Error(fmt::format("there is no video {}", path));
  const QuietCodecs quiet;
  // Decoders built into OpenCV. Other backends interpret a % in the name as a series of files.
  for (const int backend : {cv::CAP_FFMPEG, cv::CAP_OPENCV_MJPEG})
    if (!video_->isOpened()) video_->open(path, backend);
  if (video_->isOpened()) {
    refuse_absurd_size(path);
    mode_.rate_hz = video_->get(cv::CAP_PROP_FPS);
    ahead_ = read();
  }
  if (!ahead_)
    throw Error(fmt::format(
        "{} cannot be read as a video: it is damaged, empty, unreadable, or in a format "
        "for which OpenCV has no decoder here; a Motion-JPEG "
        ".avi can be read everywhere",
        path));
  mode_.width_px = ahead_->image.width;
  mode_.height_px = ahead_->image.height;
}

void VideoFile::refuse_absurd_size(const std::string& path) const {
  const double width = video_->get(cv::CAP_PROP_FRAME_WIDTH);
  const double height = video_->get(cv::CAP_PROP_FRAME_HEIGHT);
  if (width * height <= most_picture_pixels) return;
  throw Error(
      fmt::format("{} declares pictures of {:g} x {:g} pixels, more than the limit of "
                  "{:g}: it is not read",
                  path, width, height, most_picture_pixels));
}

// The file's times while they increase, else by the rate.
double VideoFile::time_of(std::int64_t number) {
  const double rate_hz = mode_.rate_hz > 0 && std::isfinite(mode_.rate_hz) ? mode_.rate_hz : 30;
  const double own_s = video_->get(cv::CAP_PROP_POS_MSEC) / 1e3;
  if (number == 0) {
    first_s_ = std::isfinite(own_s) ? own_s : 0;
    return 0;
  }
  const double t_s = own_s - first_s_;
  return std::isfinite(t_s) && t_s > last_s_ ? t_s : last_s_ + 1 / rate_hz;
}

std::optional<CameraPicture> VideoFile::read() {
  cv::Mat picture;
  if (!video_->read(picture) || picture.empty()) return std::nullopt;
  const std::int64_t number = n_read_++;
  last_s_ = time_of(number);
  return CameraPicture{image_from(picture), last_s_, number, ""};
}

std::optional<CameraPicture> VideoFile::next(double) {
  const QuietCodecs quiet;
  std::optional<CameraPicture> given = std::move(ahead_);
  ahead_ = given ? read() : std::nullopt;
  return given;
}

}  // namespace

std::unique_ptr<Camera> open_video_file(const std::string& path, const CameraRequest&) {
  return std::make_unique<VideoFile>(path);
}

}  // namespace heft
