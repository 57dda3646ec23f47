#include "tracking/ImageConversion.h"

#include <algorithm>

namespace heft {

cv::Mat mat_of(const Image& image) {
  return {image.height, image.width, CV_8UC(image.channels),
          const_cast<std::uint8_t*>(image.pixels.data())};
}

Image image_from(const cv::Mat& mat) {
  CV_Assert(mat.depth() == CV_8U && (mat.channels() == 1 || mat.channels() == 3));
  Image image(mat.cols, mat.rows, mat.channels());
  for (int row = 0; row < mat.rows; ++row)
    std::copy_n(mat.ptr(row), image.row_bytes(),
                image.pixels.data() + static_cast<std::size_t>(row) * image.row_bytes());
  return image;
}

}  // namespace heft
