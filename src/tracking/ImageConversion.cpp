#include "tracking/ImageConversion.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace heft {

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

}  // namespace heft
