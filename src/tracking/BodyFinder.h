// One body in a picture: which of the detected tags are its own, what their edges say, and which of
// its other tags can be found where its pose puts them (small or oblique tags that no detector
// reads, but whose edges can be measured).
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "base/Image.h"
#include "tracking/detection/TagDetector.h"
#include "tracking/detection/ToneLearning.h"
#include "tracking/pose/BodyPose.h"
#include "tracking/pose/DensePose.h"

namespace heft {

struct TrackerSettings {
  /// Detection on a picture smaller by this factor; 0: 1 up to 800 pixels wide, 1.5 above.
  double decimate = 0;
  bool refine_edges = true;  ///< false: the detector's own corners
  bool inner_edges = true;   ///< the effector's tags are aligned cell by cell
  bool remove_bias = true;   ///< the edge bias that blur and the tone curve cause
  /// Look where things were in the last picture, and everywhere only when they are not there.
  bool region_of_interest = true;
  double least_quality = 0.85;  ///< of a tag's edges, 0...1
};

/// Where the time of a picture went, seconds.
struct TrackerTimes {
  double detect_s = 0, refine_s = 0, pose_s = 0;
};

class BodyFinder {
 public:
  /// @throws Error as tag_pattern
  BodyFinder(const Intrinsics& camera, const MarkerBody& body, const TrackerSettings& settings,
             const EdgeMeasuring& how);

  const MarkerBody& body() const { return body_; }

  /// @param noise of the next picture, gray levels: what noise does to edges is no fault of theirs
  void expect(double noise, const ToneCurve& curve) {
    how_.noise = noise;
    how_.curve = curve;
  }
  /// What the edges of the last find told of the camera's tone curve.
  const PictureTone& tone() const { return tone_; }

  /// From detected tags. @param expected where the body may be; decides only what the picture can't
  std::optional<BodyFit> find(const Image& gray, const std::vector<DetectedTag>& detected,
                              const std::optional<Pose>& expected, const BiasPrior& prior,
                              TrackerTimes& times);

  /// What is enough to go on from where a body is expected.
  struct Enough {
    bool still = true;  ///< tags that were seen last are taken to be as blurred as they were
    int tags = 1;
    double quality = 0;
  };
  /// From where it is expected alone, within half a cell; none, and no traces, unless that is
  /// enough. Cells must be its tags'.
  std::optional<BodyFit> find_again(const Image& gray, const Pose& expected, const Enough& enough,
                                    const BiasPrior& prior, TrackerTimes& times);

  /// Of what find saw last, the mean blur of its upright edges and of its level ones, px; zero
  /// where nothing was.
  Eigen::Array2d blur_px() const;

  /// What find saw last, cell by cell; `found` where that does not help.
  /// @param rolls velocity of the body's origin, in the camera's frame, before a rolling shutter
  BodyFit aligned(const Image& gray, const BodyFit& found, const BiasPrior& prior,
                  const std::optional<Smear>& smear, const std::optional<Velocity>& rolls,
                  TrackerTimes& times) const;

  /// What find saw last, once more: its rows as a rolling shutter read them while the body moved.
  /// @param found what came of it so far  @param velocity of the body's origin, in the camera's
  /// frame
  BodyFit solve_moving(const BodyFit& found, const Velocity& velocity, const BiasPrior& prior,
                       TrackerTimes& times) const;

 private:
  std::vector<TagObservation> measure_detected(const Image& gray,
                                               const std::vector<DetectedTag>& detected,
                                               std::vector<bool>& done);
  std::optional<BodyFit> seen_again(const Image& gray, const Pose& expected, const Enough& enough,
                                    const BiasPrior& prior, TrackerTimes& times);
  /// A fit by some of the tags, with those that can be found where it puts them.
  std::optional<BodyFit> with_others(const Image& gray, const BodyFit& fit, std::vector<bool>& done,
                                     const BiasPrior& bias, TrackerTimes& times);
  /// @param covered_too tags of which two edges are clear  @param before what was seen last, if
  /// that is to be gone on from
  std::vector<TagObservation> measure_expected(const Image& gray, const Pose& camera_from_body,
                                               std::vector<bool>& done, bool covered_too,
                                               std::span<const TagObservation> before = {});
  /// @param before what was seen of it last, where that is to be gone on from
  MeasuredTag measure(const Image& gray, std::size_t tag,
                      const std::array<Eigen::Vector2d, 4>& corners_px,
                      const TagObservation* before = nullptr);
  TagObservation observed(std::size_t tag, const MeasuredTag& measured) const;
  TagObservation unrefined(std::size_t tag, const std::array<Eigen::Vector2d, 4>& corners_px) const;

  Intrinsics camera_;
  MarkerBody body_;
  TrackerSettings settings_;
  EdgeMeasuring how_;  ///< with the blur of this body's edges in the last picture
  std::vector<TagPattern> patterns_;
  PictureTone tone_;
  std::vector<TagObservation> last_tags_;  ///< of the last find, or find_again
};

}  // namespace heft
