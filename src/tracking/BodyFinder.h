// One body in a picture: which of the detected tags are its own, what their edges say, and which of
// its other tags can be found where its pose puts them (small or oblique tags that no detector
// reads, but whose edges can be measured).
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "base/Image.h"
#include "tracking/BodyPose.h"
#include "tracking/TagDetector.h"
#include "tracking/Tracker.h"

namespace heft {

class BodyFinder {
 public:
  /// @throws Error as looks_of in TagEdges.h
  BodyFinder(const Intrinsics& camera, const MarkerBody& body, const TrackerSettings& settings,
             int most_edge_pixels);

  const MarkerBody& body() const { return body_; }

  /// From detected tags. @param expected where the body may be; decides only what the picture can't
  std::optional<BodyFit> find(const Image& gray, const std::vector<DetectedTag>& detected,
                              const std::optional<Pose>& expected, const BiasPrior& prior,
                              TrackerTimes& times);

  /// From where it is expected alone; none unless at least least_tags are there.
  std::optional<BodyFit> find_again(const Image& gray, const Pose& expected, int least_tags,
                                    const BiasPrior& prior, TrackerTimes& times);

 private:
  std::vector<TagObservation> measure_detected(const Image& gray,
                                               const std::vector<DetectedTag>& detected,
                                               std::vector<bool>& done);
  std::vector<TagObservation> measure_expected(const Image& gray, const Pose& camera_from_body,
                                               std::vector<bool>& done);
  MeasuredTag measure(const Image& gray, std::size_t tag,
                      const std::array<Eigen::Vector2d, 4>& corners_px);
  TagObservation unrefined(std::size_t tag, const std::array<Eigen::Vector2d, 4>& corners_px) const;

  Intrinsics camera_;
  MarkerBody body_;
  TrackerSettings settings_;
  int most_edge_pixels_;
  std::vector<TagLook> looks_;
  double blur_px_;  ///< of this body's edges in the last picture
};

}  // namespace heft
