// Between the house's pictures and poses and OpenCV's.
#pragma once

#include <opencv2/core.hpp>

#include "base/Image.h"
#include "base/Pose.h"

namespace heft {

/// The image's own pixels, not to be written to.
cv::Mat mat_of(const Image& image);

/// In 1 channel.
Image gray_of(const Image& image);

/// A copy. @param mat 8 bits, 1 or 3 channels
Image image_from(const cv::Mat& mat);

/// @param turn rotation vector
Pose pose_from(const cv::Vec3d& turn, const cv::Vec3d& shift_m);

}  // namespace heft
