// Picture files, video files and V4L2 cameras by OpenCV's imgcodecs and videoio. The two bring some
// two hundred shared libraries along (GDAL and FFmpeg with all of theirs), an eighth of a second at
// each start of a program that mostly sees no picture. So they are a module by themselves, loaded
// by whoever asks first.
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

/// What the module has. All that OpenCV's two classes do once they are made is virtual.
struct Codecs {
  bool (*read)(const std::string& path, cv::Mat& picture);  ///< @throws cv::Exception
  bool (*write)(const std::string& path, const cv::Mat& picture);
  /// Compressed and decompressed. @param quality 1 to 100
  void (*through_jpeg)(const cv::Mat& picture, int quality, cv::Mat& back);
  std::unique_ptr<cv::VideoCapture> (*capture)();  ///< not open yet
  /// Not open if it can't be. @param backend of cv::VideoCaptureAPIs
  std::unique_ptr<cv::VideoWriter> (*writer)(const std::string& path, int backend, int four_cc,
                                             double rate_hz, int width, int height);
};

/// Loaded when first called, by any thread.
/// @throws Error naming the module and what is wrong with it, if it can't be
const Codecs& codecs();

/// The number that stands for four letters, such as MJPG.
constexpr int four_cc(const std::array<char, 4>& letters) {
  int code = 0;
  for (std::size_t i = 0; i < letters.size(); ++i)
    code |= static_cast<unsigned char>(letters[i]) << (8 * i);
  return code;
}

}  // namespace heft
