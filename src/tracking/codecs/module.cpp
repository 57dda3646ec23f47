// heft-codecs.so: all that calls OpenCV's imgcodecs and videoio by name.
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

#include "tracking/codecs/Codecs.h"

extern "C" __attribute__((visibility("default"))) const heft::Codecs heft_codecs{
    [](const std::string& path, cv::Mat& picture) {
      picture = cv::imread(path, cv::IMREAD_ANYCOLOR);
      return !picture.empty();
    },
    [](const std::string& path, const cv::Mat& picture) { return cv::imwrite(path, picture); },
    [] { return std::make_unique<cv::VideoCapture>(); },
    [](const std::string& path, int backend, int four_cc, double rate_hz, int width, int height) {
      return std::make_unique<cv::VideoWriter>(path, backend, four_cc, rate_hz,
                                               cv::Size(width, height));
    }};
