// heft-codecs.so: the only file that links OpenCV's imgcodecs and videoio.
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

#include "base/Program.h"
#include "tracking/codecs/Codecs.h"

namespace {
void through_jpeg(const cv::Mat& picture, int quality, cv::Mat& back) {
  std::vector<unsigned char> bytes;
  cv::imencode(".jpg", picture, bytes, {cv::IMWRITE_JPEG_QUALITY, quality});
  cv::imdecode(bytes, cv::IMREAD_COLOR, &back);
}
}  // namespace

extern "C" __attribute__((visibility("default"))) const heft::Codecs heft_codecs{
    [](const std::string& path, cv::Mat& picture) {
      picture = cv::imread(path, cv::IMREAD_ANYCOLOR);
      return !picture.empty();
    },
    [](const std::string& path, const cv::Mat& picture) { return cv::imwrite(path, picture); },
    through_jpeg, [] { return std::make_unique<cv::VideoCapture>(); },
    [](const std::string& path, int backend, int four_cc, double rate_hz, int width, int height) {
      return std::make_unique<cv::VideoWriter>(path, backend, four_cc, rate_hz,
                                               cv::Size(width, height));
    }};
extern "C" __attribute__((visibility("default"))) const char* const heft_codecs_edition =
    heft::module_edition;
