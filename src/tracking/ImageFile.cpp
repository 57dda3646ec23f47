#include "tracking/ImageFile.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>

#include "base/Error.h"
#include "tracking/ImageConversion.h"

namespace heft {

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
    throw Error(fmt::format("{} is not a file, so no picture", path));
  cv::Mat picture;
  try {
    picture = cv::imread(path, cv::IMREAD_ANYCOLOR);
  } catch (const cv::Exception&) {  // what the codec says is about its own code, not the file
  }
  if (picture.empty())
    throw Error(
        fmt::format("{} can't be read as a picture: it is damaged, cut off, not readable "
                    "for you, or of a kind other than {}",
                    path, known_endings()));
  return image_from(picture);
}

void write_image(const std::string& path, const Image& image) {
  if (!is_image_file(path))
    throw Error(fmt::format("{}: a picture's name must end in one of {}", path, known_endings()));
  bool written = false;
  try {
    written = cv::imwrite(path, mat_of(image));
  } catch (const cv::Exception&) {
  }
  if (!written)
    throw Error(
        fmt::format("{} can't be written: check that its folder is there, that you may "
                    "write to it and that the disk is not full",
                    path));
}

}  // namespace heft
