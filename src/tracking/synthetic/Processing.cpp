#include "tracking/synthetic/Processing.h"

#include <opencv2/imgproc.hpp>

#include "tracking/camera/ImageConversion.h"
#include "tracking/codecs/Codecs.h"

namespace heft {

namespace {
// Bayer mosaic of blue, green over green, red: each pixel keeps one color.
cv::Mat through_mosaic(const cv::Mat& picture) {
  cv::Mat one_color(picture.size(), CV_8UC1), colors;
  for (int y = 0; y < picture.rows; ++y)
    for (int x = 0; x < picture.cols; ++x)
      one_color.at<std::uint8_t>(y, x) = picture.at<cv::Vec3b>(y, x)[x % 2 + y % 2];
  cv::cvtColor(one_color, colors, cv::COLOR_BayerBGGR2BGR);
  return colors;
}

cv::Mat sharpened(const cv::Mat& picture, double strength) {
  constexpr double sd_px = 1;
  cv::Mat smooth, sharp;
  cv::GaussianBlur(picture, smooth, {7, 7}, sd_px);
  cv::addWeighted(picture, 1 + strength, smooth, -strength, 0, sharp);
  return sharp;
}

cv::Mat through_jpeg(const cv::Mat& picture, int quality) {
  cv::Mat back;
  codecs().through_jpeg(picture, quality, back);
  return back;
}
}  // namespace

Image processed(Image picture, const Optics& optics) {
  if (!optics.mosaic && !(optics.sharpening > 0) && optics.jpeg_quality == 0) return picture;
  cv::Mat now = mat_of(picture);
  if (optics.mosaic) now = through_mosaic(now);
  if (optics.sharpening > 0) now = sharpened(now, optics.sharpening);
  if (optics.jpeg_quality > 0) now = through_jpeg(now, optics.jpeg_quality);
  return image_from(now);
}

}  // namespace heft
