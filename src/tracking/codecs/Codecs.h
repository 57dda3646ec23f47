// Picture files, video files and V4L2 cameras by OpenCV's imgcodecs and videoio. These bring some
// two hundred shared libraries (GDAL, FFmpeg). Linked to the program, they would add 105 ms and 56
// MB to each start, which takes 14 ms and 20 MB without them. Hence this module, loaded on first
// use.
#pragma once

#include <array>
#include <memory>
#include <string>

namespace cv {
class Mat;
class VideoCapture;
class VideoWriter;
}  // namespace cv

namespace heft {

/// Functions of the module. OpenCV's two classes need no others, because their methods are virtual.
struct Codecs {
  bool (*read)(const std::string& path, cv::Mat& picture);  ///< @throws cv::Exception
  bool (*write)(const std::string& path, const cv::Mat& picture);
  /// Compresses and decompresses. @param quality 1 to 100
  void (*through_jpeg)(const cv::Mat& picture, int quality, cv::Mat& back);
  std::unique_ptr<cv::VideoCapture> (*capture)();  ///< not open yet
  /// Not open if that failed. @param backend of cv::VideoCaptureAPIs
  std::unique_ptr<cv::VideoWriter> (*writer)(const std::string& path, int backend, int four_cc,
                                             double rate_hz, int width, int height);
};

/// A picture or video of more pixels a frame is refused before it is decoded.
inline constexpr double most_picture_pixels = 1e8;

/// Loads the module on first use, with that limit. Thread-safe.
/// @throws Error naming the module and the reason if it cannot be loaded
const Codecs& codecs();

/// The code of a four-character name such as MJPG.
constexpr int four_cc(const std::array<char, 4>& letters) {
  int code = 0;
  for (std::size_t i = 0; i < letters.size(); ++i)
    code |= static_cast<unsigned char>(letters[i]) << (8 * i);
  return code;
}

}  // namespace heft
