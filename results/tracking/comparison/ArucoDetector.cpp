#include "results/tracking/comparison/ArucoDetector.h"

#ifdef HEFT_HAVE_ARUCO

#include <fmt/format.h>

#include <opencv2/aruco.hpp>

#include "base/Error.h"
#include "tracking/camera/ImageConversion.h"

namespace heft {

namespace {
// OpenCV's dictionary holds the family's tags upside down.
DetectedTag upright(int id, const std::vector<cv::Point2f>& corners) {
  DetectedTag tag{id, {}, 0};
  for (std::size_t i = 0; i < 4; ++i) {
    const cv::Point2f& corner = corners[(i + 2) % 4];
    tag.corners_px[i] = Eigen::Vector2d(corner.x, corner.y);
  }
  return tag;
}
}  // namespace

struct ArucoDetector::Impl {
  cv::Ptr<cv::aruco::Dictionary> dictionary =
      cv::aruco::getPredefinedDictionary(cv::aruco::DICT_APRILTAG_36h11);
  cv::Ptr<cv::aruco::DetectorParameters> parameters = cv::aruco::DetectorParameters::create();
};

ArucoDetector::ArucoDetector(const std::string& family, ArucoCorners corners)
    : impl_(std::make_unique<Impl>()) {
  if (family != "tag36h11")
    throw Error(fmt::format("the aruco comparison knows tag36h11 alone, not {}", family));
  impl_->parameters->cornerRefinementMethod = corners == ArucoCorners::apriltag
                                                  ? cv::aruco::CORNER_REFINE_APRILTAG
                                                  : cv::aruco::CORNER_REFINE_NONE;
}

ArucoDetector::~ArucoDetector() = default;
ArucoDetector::ArucoDetector(ArucoDetector&&) noexcept = default;

std::vector<DetectedTag> ArucoDetector::detect(const Image& gray) {
  std::vector<std::vector<cv::Point2f>> corners;
  std::vector<int> ids;
  cv::aruco::detectMarkers(mat_of(gray), impl_->dictionary, corners, ids, impl_->parameters);
  std::vector<DetectedTag> tags;
  for (std::size_t i = 0; i < ids.size(); ++i) tags.push_back(upright(ids[i], corners[i]));
  return tags;
}

}  // namespace heft

#endif
