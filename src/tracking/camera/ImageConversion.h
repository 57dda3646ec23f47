// Conversions between Heft's images and poses and OpenCV's.
#pragma once

#include <mutex>
#include <opencv2/core.hpp>

#include "base/Image.h"
#include "base/PoseTypes.h"

namespace heft {

/// A view of the image's pixels, read-only.
cv::Mat mat_of(const Image& image);

/// While it exists, stderr is redirected to hide messages of OpenCV and its codecs about their own
/// code. That affects other threads, too, so keep it short.
class QuietCodecs {
 public:
  QuietCodecs();
  ~QuietCodecs();
  QuietCodecs(const QuietCodecs&) = delete;
  QuietCodecs& operator=(const QuietCodecs&) = delete;

 private:
  std::unique_lock<std::mutex> one_at_a_time_;
  int stderr_;  ///< the original; -1: not redirected
};

/// Converts to 1 channel.
Image gray_of(const Image& image);

/// A copy. @param mat 8 bits, 1 or 3 channels
Image image_from(const cv::Mat& mat);

/// @param turn rotation vector
Pose pose_from(const cv::Vec3d& turn, const cv::Vec3d& shift_m);

}  // namespace heft
