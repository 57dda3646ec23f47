// Finds one body in a picture: selects its detected tags, measures their edges, and finds further
// tags where its pose puts them (small or oblique tags that the detector does not read, but whose
// edges can be measured).
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "base/Image.h"
#include "tracking/detection/TagDetector.h"
#include "tracking/detection/ToneLearning.h"
#include "tracking/pose/BodyPose.h"
#include "tracking/pose/CellBias.h"
#include "tracking/pose/DensePose.h"

namespace heft {

struct TrackerSettings {
  /// Detection on a picture reduced by this factor; 0: 1 up to 800 pixels wide, 1.5 above.
  double decimate = 0;
  bool refine_edges = true;  ///< false: uses the detector's corners
  bool inner_edges = true;   ///< the effector's tags are aligned cell by cell
  bool remove_bias = true;   ///< corrects the edge bias caused by blur and the tone curve
  /// Search near the last poses first, and everywhere only if that fails.
  bool region_of_interest = true;
  double least_quality = 0.85;  ///< of a tag's edges, 0...1
};

/// Processing times of a picture, seconds.
struct TrackerTimes {
  double detect_s = 0, refine_s = 0, pose_s = 0;
};

class BodyFinder {
 public:
  /// @throws Error as tag_pattern
  BodyFinder(const Intrinsics& camera, const MarkerBody& body, const TrackerSettings& settings,
             const EdgeMeasuring& how);

  const MarkerBody& body() const { return body_; }

  /// @param noise of the next picture, gray levels, which lowers the quality of edges
  void expect(double noise, const ToneCurve& curve) {
    how_.noise = noise;
    how_.curve = curve;
  }
  /// The lens's focal length has changed.
  void refocus(const Intrinsics& camera) { camera_ = camera; }
  /// The body with other sizes of its tags.
  void resize(const MarkerBody& body) {
    body_ = body;
    last_tags_.clear();
  }
  /// Edge bias of cells, from some tags of the last find.
  std::optional<CellBias> cells(const Image& gray, const BodyFit& fit) const {
    return cell_bias(gray, camera_, patterns_, last_tags_, fit, how_.curve, how_.noise, 8);
  }
  /// Error of the focal length, from the last find.
  FocalError focal_error(const BodyFit& fit, const BiasPrior& prior) const {
    return heft::focal_error(last_tags_, fit, prior);
  }
  /// Information on the camera's tone curve from the edges of the last find.
  const PictureTone& tone() const { return tone_; }

  /// The part of the picture where the body is expected, with a margin for changes of motion.
  Region region_around(const Pose& camera_from_body) const;

  /// What is known before a body is found.
  struct Known {
    std::optional<Pose> expected;  ///< pose of the body; used only to resolve ambiguities
    BiasPrior bias;
    std::optional<Pose> camera_from_table = {};  ///< the body is above it
  };
  /// Finds the body from detected tags, which may hold one tag several times.
  std::optional<BodyFit> find(const Image& gray, const std::vector<DetectedTag>& detected,
                              const Known& known, TrackerTimes& times);
  /// Tags of the last find that are not the body's: of a second print with the same numbers.
  int n_foreign() const { return n_foreign_; }

  /// Requirements for continuing from an expected pose.
  struct Enough {
    bool still = true;  ///< the last tags are assumed to have the same blur
    int tags = 1;
    double quality = 0;
  };
  /// Finds the body from its expected pose alone, within half a cell; none, without side effects,
  /// unless the requirements are met. Cells must match its tags.
  std::optional<BodyFit> find_again(const Image& gray, const Pose& expected, const Enough& enough,
                                    const BiasPrior& prior, TrackerTimes& times);

  /// Mean blur of the upright and of the level edges of the last find, px; zero if none.
  Eigen::Array2d blur_px() const;

  /// Aligns the tags of the last find cell by cell; returns `found` if that does not help.
  /// @param rolls velocity of the body's origin, in the camera's frame, under a rolling shutter
  BodyFit aligned(const Image& gray, const BodyFit& found, const BiasPrior& prior,
                  const std::optional<Smear>& smear, const std::optional<Velocity>& rolls,
                  TrackerTimes& times) const;

  /// Solves the last find again with its rows at the times that a rolling shutter reads them.
  /// @param found the result so far  @param velocity of the body's origin, in the camera's frame
  BodyFit solve_moving(const BodyFit& found, const Velocity& velocity, const BiasPrior& prior,
                       TrackerTimes& times) const;

 private:
  struct Measured {
    std::vector<TagObservation> clear, rough;  ///< with and without measured edges
  };
  Measured measure_detected(const Image& gray, const std::vector<DetectedTag>& detected,
                            std::vector<bool>& done);
  /// The fit of the tags that fit one pose above the table.
  std::optional<BodyFit> fit_own(const std::vector<TagObservation>& tags, const Known& known,
                                 const BiasPrior& bias);
  std::optional<BodyFit> seen_again(const Image& gray, const Pose& expected, const Enough& enough,
                                    const BiasPrior& prior, TrackerTimes& times);
  /// Extends a fit by tags that can be found where it puts them.
  std::optional<BodyFit> with_others(const Image& gray, const BodyFit& fit, std::vector<bool>& done,
                                     const BiasPrior& bias, TrackerTimes& times);
  /// @param covered_too also tags with only two clear edges  @param before the last observations,
  /// to continue from
  std::vector<TagObservation> measure_expected(const Image& gray, const Pose& camera_from_body,
                                               std::vector<bool>& done, bool covered_too,
                                               std::span<const TagObservation> before = {});
  /// @param before the last observation of the tag, to continue from
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
  int n_foreign_ = 0;
};

}  // namespace heft
