#include "tracking/camera/ImageFile.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <opencv2/imgproc.hpp>

#include "base/Error.h"
#include "base/Pose.h"
#include "tracking/camera/ImageConversion.h"
#include "tracking/codecs/Codecs.h"

namespace heft {

QuietCodecs::QuietCodecs() : stderr_(-1) {
  static std::mutex one;
  one_at_a_time_ = std::unique_lock(one);
  std::fflush(stderr);
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere < 0) return;
  stderr_ = fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 3);
  if (stderr_ >= 0) dup2(nowhere, STDERR_FILENO);
  close(nowhere);
}

QuietCodecs::~QuietCodecs() {
  std::fflush(stderr);
  if (stderr_ < 0) return;
  dup2(stderr_, STDERR_FILENO);
  close(stderr_);
}

cv::Mat mat_of(const Image& image) {
  return {image.height, image.width, CV_8UC(image.channels),
          const_cast<std::uint8_t*>(image.pixels.data())};
}

Image gray_of(const Image& image) {
  if (image.channels == 1) return image;
  Image gray(image.width, image.height, 1);
  cv::Mat to(image.height, image.width, CV_8UC1, gray.pixels.data());
  cv::cvtColor(mat_of(image), to, cv::COLOR_BGR2GRAY);
  return gray;
}

Image image_from(const cv::Mat& mat) {
  CV_Assert(mat.depth() == CV_8U && (mat.channels() == 1 || mat.channels() == 3));
  Image image(mat.cols, mat.rows, mat.channels());
  for (int row = 0; row < mat.rows; ++row)
    std::copy_n(mat.ptr(row), image.row_bytes(),
                image.pixels.data() + static_cast<std::size_t>(row) * image.row_bytes());
  return image;
}

Pose pose_from(const cv::Vec3d& turn, const cv::Vec3d& shift_m) {
  return {{shift_m[0], shift_m[1], shift_m[2]}, rotation_from_vector({turn[0], turn[1], turn[2]})};
}

namespace {
namespace fs = std::filesystem;

std::string ending_of(const std::string& path) {
  std::string ending = fs::path(path).extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending;
}

constexpr std::array endings{".png", ".jpg", ".jpeg", ".bmp", ".pgm",
                             ".ppm", ".pnm", ".tif",  ".tiff"};

std::string known_endings() {
  return fmt::format("{}", fmt::join(endings, " "));
}
}  // namespace

bool is_image_file(const std::string& path) {
  return std::ranges::find(endings, ending_of(path)) != endings.end();
}

Image read_image(const std::string& path) {
  std::error_code ignored;
  if (!fs::exists(path, ignored)) throw Error(fmt::format("there is no picture {}", path));
  if (!fs::is_regular_file(path, ignored))
    throw Error(fmt::format("{} is not a file, expected a picture", path));
  cv::Mat picture;
  try {
    const QuietCodecs quiet;
    codecs().read(path, picture);
  } catch (const cv::Exception&) {  // about the codec's own code, or too large
  }
  if (picture.empty())
    throw Error(
        fmt::format("{} cannot be read as a picture: it is damaged, truncated, unreadable, larger "
                    "than {:g} pixels, or in a format other than {}",
                    path, most_picture_pixels, known_endings()));
  return image_from(picture);
}

void write_image(const std::string& path, const Image& image) {
  if (!is_image_file(path))
    throw Error(fmt::format("{}: a picture's name must end in one of {}", path, known_endings()));
  bool written = false;
  try {
    written = codecs().write(path, mat_of(image));
  } catch (const cv::Exception&) {
  }
  if (!written)
    throw Error(
        fmt::format("{} cannot be written: check that its folder exists and is writable, and that "
                    "the disk is not full",
                    path));
}

}  // namespace heft
