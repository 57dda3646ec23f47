// From pixels to poses: finds the board's and the effector's tags, measures their edges on linear
// light, and solves for both poses. Unfiltered: PoseFilter.h smooths.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/Image.h"
#include "base/PoseTypes.h"
#include "tracking/BodyFinder.h"
#include "tracking/SeenEffector.h"
#include "tracking/detection/TagDetector.h"
#include "tracking/pose/MarkerBody.h"

namespace heft {

/// A pose of less quality is no pose: it may be centimeters off.
inline constexpr double least_pose_quality = 0.05;

struct TrackedPicture {
  std::optional<Pose> camera_from_board;
  /// Only with the board. Of a camera with a readout_s: when the effector's own row was read, so
  /// that what is drawn at it lies over the filmed one.
  std::optional<Pose> board_from_effector;
  double effector_t_s =
      0;  ///< then; the picture's time where there is no readout_s, or no effector
  int n_board_tags = 0, n_effector_tags = 0;
  int n_effector_faces = 0;  ///< on which those tags are; two make a pose firm
  /// RMS distance of the measured tag edges from where the pose puts them.
  double board_reprojection_px = 0, effector_reprojection_px = 0;
  /// 0...1: how far the effector's pose can be trusted (the board's where there is no effector):
  /// the fraction of pixels around its tags' edges that look like edges; halved where two poses fit
  /// about equally well, where the reprojection error is 1 pixel, and where its tags leave the
  /// effector's place open by half a millimeter, as a single slanted one may, or its farthest tag
  /// corner by two, as two tilts do that look alike; less than half where the picture is
  /// overexposed. 0 where nothing was found, never between that and least_pose_quality.
  double quality = 0;
  /// The effector is not where motion could have taken it since it was last seen, or was not seen
  /// for so long that nothing can be said.
  bool jump = false;
  /// Of the board's tags, outwards, black tags that look small: negative; what the learned tone
  /// curve leaves of it.
  double edge_bias_px = 0;
  TrackerTimes times;
};

/// One tracker is used by one thread.
class Tracker {
 public:
  /// @throws Error for a board without tags, a family that the detector does not have, an id that a
  ///   family does not have, or a tag that is on both bodies
  explicit Tracker(const Apparatus& apparatus, const TrackerSettings& settings = {});

  /// @param t_s the picture's capture time; times increase
  /// @throws Error when the picture is not of the size that the camera was calibrated for
  TrackedPicture track(const Image& image, double t_s);

  /// What it takes the camera's tone curve to be: the camera file's response, and what the pictures
  /// since have told.
  const ToneCurve& tone() const { return tone_.curve(); }
  /// Whether pictures have told anything of it: sRGB may be what they told.
  bool tone_is_told() const { return tone_.is_told(); }

  /// Forgets the last poses: what comes next is no continuation. The camera stays the same.
  void reset();

 private:
  bool has_effector() const { return !effector_.body().tags.empty(); }
  std::vector<DetectedTag> detect(TagDetector& detector, const Region& region,
                                  EdgeSearch search = EdgeSearch::above_noise);
  const std::vector<DetectedTag>& all_board_tags();
  std::vector<DetectedTag> all_effector_tags();
  std::optional<BodyFit> find_board();
  std::optional<BodyFit> learn_tone(std::optional<BodyFit> board);
  void expect_picture();
  std::optional<BodyFit> find_effector(const BodyFit& seen_board, double t_s);
  std::optional<Smear> smear(const Pose& board_from_effector, const BodyFit& seen_board,
                             double t_s) const;
  BodyFit unrolled(BodyFit fit, const BodyFit& seen_board, const BiasPrior& prior, double t_s);
  void take_board(const std::optional<BodyFit>& fit);
  void take_effector(const BodyFit& fit, double t_s);

  Intrinsics camera_;
  TrackerSettings settings_;
  BodyFinder board_, effector_;
  ToneLearner tone_;
  std::vector<TagDetector> detectors_;  ///< one, or the board's and the effector's

  // Of the picture at hand.
  Image gray_;
  std::optional<std::vector<DetectedTag>> board_family_tags_;
  TrackedPicture result_;

  // Of the pictures before it.
  std::optional<Pose> last_board_;
  int last_n_board_tags_ = 0;
  int n_without_board_ = 0;  ///< pictures
  std::optional<SeenEffector> seen_;
  int n_unseen_ = 0;  ///< pictures since, or since the start
};

// Why a board or an effector was found in no picture: what one of them shows instead.

/// A picture in which the body was not found, in words: dark, white, mirrored, with other tags,
/// without any. Takes as long as several detections.
/// @param what the body is called  @param beside may be in the picture, too: the other body
std::string why_unseen(const Image& picture, const MarkerBody& body, const std::string& what,
                       const MarkerBody& beside = {});

}  // namespace heft
