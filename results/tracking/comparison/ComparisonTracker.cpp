#include "results/tracking/comparison/ComparisonTracker.h"

#include <array>
#include <opencv2/core/utility.hpp>

#include "results/tracking/comparison/ArucoDetector.h"
#include "results/tracking/comparison/BodyPnp.h"
#include "tracking/camera/ImageConversion.h"

namespace heft {

namespace {
// libapriltag as it comes, on the whole picture.
class AprilTags {
 public:
  AprilTags(const std::string& family, double decimate) : detector_(family, decimate) {}
  std::vector<DetectedTag> detect(const Image& gray) {
    return detector_.detect(gray, whole(gray), EdgeSearch::everywhere);
  }

 private:
  TagDetector detector_;
};

using PoseFromTags = std::optional<Pose> (*)(const Intrinsics&, const MarkerBody&,
                                             const std::vector<DetectedTag>&);

template <typename Detector>
class DetectThenPose final : public ComparisonTracker {
 public:
  DetectThenPose(const Apparatus& apparatus, Detector detector, PoseFromTags pose)
      : apparatus_(apparatus), detector_(std::move(detector)), pose_(pose) {}

  ComparisonPoses track(const Image& image) override {
    tags_ = detector_.detect(gray_of(image));
    return {pose_(apparatus_.camera, apparatus_.board, tags_),
            pose_(apparatus_.camera, apparatus_.effector, tags_)};
  }

  const std::vector<DetectedTag>& tags() const override { return tags_; }

 private:
  Apparatus apparatus_;
  Detector detector_;
  PoseFromTags pose_;
  std::vector<DetectedTag> tags_;
};

template <PoseFromTags pose>
std::unique_ptr<ComparisonTracker> apriltag_chain(const Apparatus& apparatus, double decimate) {
  return std::make_unique<DetectThenPose<AprilTags>>(
      apparatus, AprilTags(apparatus.board.family, decimate), pose);
}

#ifdef HEFT_HAVE_ARUCO
template <ArucoCorners corners>
std::unique_ptr<ComparisonTracker> aruco_chain(const Apparatus& apparatus, double) {
  return std::make_unique<DetectThenPose<ArucoDetector>>(
      apparatus, ArucoDetector(apparatus.board.family, corners), pose_by_solvepnp);
}
#endif

constexpr std::array table{
    ComparisonEntry{"apriltag + solvePnP",
                    "AprilTag's corners of all tags of a body into cv::solvePnP", true,
                    apriltag_chain<pose_by_solvepnp>},
    ComparisonEntry{"apriltag + IPPE", "a body is where its largest tag is, by cv::solvePnP's IPPE",
                    true, apriltag_chain<pose_of_largest_tag>},
#ifdef HEFT_HAVE_ARUCO
    ComparisonEntry{"aruco + solvePnP", "OpenCV's aruco detector, corners not refined", false,
                    aruco_chain<ArucoCorners::plain>},
    ComparisonEntry{"aruco(apriltag) + solvePnP",
                    "OpenCV's aruco detector with its AprilTag refinement", false,
                    aruco_chain<ArucoCorners::apriltag>},
#endif
};
}  // namespace

std::span<const ComparisonEntry> comparison_trackers() {
  return table;
}

bool has_aruco() {
#ifdef HEFT_HAVE_ARUCO
  return true;
#else
  return false;
#endif
}

void keep_opencv_on_one_thread() {
  cv::setNumThreads(1);
}

}  // namespace heft
