#include "tracking/camera/ImageFile.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <climits>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <opencv2/imgproc.hpp>
#include <sstream>

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

namespace {
using Bytes = std::vector<unsigned char>;

int big_endian(const Bytes& bytes, std::size_t at, std::size_t n) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < n; ++i) value = value << 8 | bytes.at(at + i);
  return static_cast<int>(std::min<std::uint32_t>(value, INT_MAX));
}

int little_endian(const Bytes& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 4; i-- > 0;) value = value << 8 | bytes.at(at + i);
  const auto number = static_cast<std::int32_t>(value);  // BMP: negative for rows from the top
  return number == INT_MIN ? INT_MAX : std::abs(number);
}

bool starts_with(const Bytes& bytes, std::string_view text) {
  return bytes.size() >= text.size() &&
         std::equal(text.begin(), text.end(), bytes.begin(),
                    [](char a, unsigned char b) { return static_cast<unsigned char>(a) == b; });
}

// Skips segments, each with its length, up to a frame header.
std::optional<PictureSize> jpeg_size(const Bytes& bytes) {
  for (std::size_t at = 2; at + 9 < bytes.size() && bytes[at] == 0xFF;) {
    const unsigned char kind = bytes[at + 1];
    const bool is_frame =
        kind >= 0xC0 && kind <= 0xCF && kind != 0xC4 && kind != 0xC8 && kind != 0xCC;
    if (is_frame) return PictureSize{big_endian(bytes, at + 7, 2), big_endian(bytes, at + 5, 2)};
    at += 2 + static_cast<std::size_t>(big_endian(bytes, at + 2, 2));
  }
  return std::nullopt;
}

// "P5 640 480", with comments.
std::optional<PictureSize> pnm_size(const Bytes& bytes) {
  std::istringstream text(std::string(bytes.begin() + 2, bytes.end()));
  PictureSize size;
  for (int* side : {&size.width, &size.height}) {
    while (text >> std::ws && text.peek() == '#') text.ignore(INT_MAX, '\n');
    if (!(text >> *side)) return std::nullopt;
  }
  return size;
}
// Numbers of 16 or 32 bits in either byte order. The first directory may be anywhere in the file: a
// number of entries, each of 12 bytes: tag, type, count, value.
std::optional<PictureSize> tiff_size(const Bytes& header, std::istream& file) {
  const bool little = header[0] == 'I';
  const auto number = [&](const Bytes& bytes, std::size_t at, std::size_t n) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < n; ++i)
      value |= std::uint32_t{bytes.at(at + i)} << 8 * (little ? i : n - 1 - i);
    return value;
  };
  constexpr std::uint32_t width = 256, height = 257, short_kind = 3;
  constexpr std::size_t most_entries = 200;
  Bytes directory(2 + 12 * most_entries);
  file.clear();
  file.seekg(number(header, 4, 4));
  file.read(reinterpret_cast<char*>(directory.data()),
            static_cast<std::streamsize>(directory.size()));
  directory.resize(static_cast<std::size_t>(std::max<std::streamsize>(0, file.gcount())));
  PictureSize size;
  for (std::size_t at = 2; at + 12 <= directory.size(); at += 12) {
    if ((at - 2) / 12 >= number(directory, 0, 2)) break;
    const bool is_short = number(directory, at + 2, 2) == short_kind;
    const std::uint32_t value = number(directory, at + 8, is_short ? 2 : 4);
    const int side = static_cast<int>(std::min<std::uint32_t>(value, INT_MAX));
    if (number(directory, at, 2) == width) size.width = side;
    if (number(directory, at, 2) == height) size.height = side;
  }
  if (size.width == 0 || size.height == 0) return std::nullopt;
  return size;
}
}  // namespace

std::optional<PictureSize> size_in_header(const std::string& path) {
  constexpr std::size_t most_bytes = 1 << 18;  // JPEGs may begin with a thumbnail
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored))
    return std::nullopt;  // opening a pipe could wait forever
  Bytes bytes(most_bytes);
  std::ifstream file(path, std::ios::binary);
  file.read(reinterpret_cast<char*>(bytes.data()), most_bytes);
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  if (bytes.size() < 26) return std::nullopt;
  if (starts_with(bytes, "\x89PNG"))
    return PictureSize{big_endian(bytes, 16, 4), big_endian(bytes, 20, 4)};
  if (starts_with(bytes, "BM"))
    return PictureSize{little_endian(bytes, 18), little_endian(bytes, 22)};
  if (starts_with(bytes, "\xFF\xD8")) return jpeg_size(bytes);
  if (starts_with(bytes, "II*") || starts_with(bytes, {"MM\0*", 4})) return tiff_size(bytes, file);
  if (bytes[0] == 'P' && bytes[1] >= '1' && bytes[1] <= '6') return pnm_size(bytes);
  return std::nullopt;
}

bool is_image_file(const std::string& path) {
  return std::ranges::find(endings, ending_of(path)) != endings.end();
}

Image read_image(const std::string& path) {
  std::error_code ignored;
  if (!fs::exists(path, ignored)) throw Error(fmt::format("there is no picture {}", path));
  if (!fs::is_regular_file(path, ignored))
    throw Error(fmt::format("{} is not a file, expected a picture", path));
  const PictureSize size = size_in_header(path).value_or(PictureSize{});
  if (static_cast<double>(size.width) * size.height > most_picture_pixels)
    throw Error(
        fmt::format("{} declares {} x {} pixels, more than the limit of {:g}: it is not read", path,
                    size.width, size.height, most_picture_pixels));
  cv::Mat picture;
  try {
    const QuietCodecs quiet;
    codecs().read(path, picture);
  } catch (const cv::Exception&) {  // the codec's message is about its own code
  }
  if (picture.empty())
    throw Error(
        fmt::format("{} cannot be read as a picture: it is damaged, truncated, unreadable, or in "
                    "a format other than {}",
                    path, known_endings()));
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
