// Between the house's pictures and poses and OpenCV's.
#pragma once

#include <mutex>
#include <opencv2/core.hpp>

#include "base/Image.h"
#include "base/PoseTypes.h"

namespace heft {

/// The image's own pixels, not to be written to.
cv::Mat mat_of(const Image& image);

/// While there is one, what OpenCV and its codecs say on stderr by themselves is not heard: their
/// words are about their own code. Nor is what any other thread says there, so keep it short.
class QuietCodecs {
 public:
  QuietCodecs();
  ~QuietCodecs();
  QuietCodecs(const QuietCodecs&) = delete;
  QuietCodecs& operator=(const QuietCodecs&) = delete;

 private:
  std::unique_lock<std::mutex> one_at_a_time_;
  int stderr_;  ///< kept meanwhile; -1: it is not redirected
};

/// In 1 channel.
Image gray_of(const Image& image);

/// A copy. @param mat 8 bits, 1 or 3 channels
Image image_from(const cv::Mat& mat);

/// @param turn rotation vector
Pose pose_from(const cv::Vec3d& turn, const cv::Vec3d& shift_m);

}  // namespace heft
