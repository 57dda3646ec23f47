// From pixels to poses: finds the tags of board and effector, measures their edges in linear light,
// and solves for both poses. Not filtered, see PoseFilter.h.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/Image.h"
#include "base/PoseTypes.h"
#include "tracking/BodyFinder.h"
#include "tracking/SeenEffector.h"
#include "tracking/detection/MarkerBody.h"
#include "tracking/detection/TagDetector.h"
#include "tracking/detection/TemporalMix.h"
#include "tracking/pose/FocusLearner.h"

namespace heft {

/// A pose of lower quality is discarded: its error may be centimeters.
inline constexpr double least_pose_quality = 0.05;

struct TrackedPicture {
  std::optional<Pose> camera_from_board;
  /// None without the board. For a camera with a readout_s, the pose at the time when the
  /// effector's own row was read, so that drawings at it match the filmed effector.
  std::optional<Pose> board_from_effector;
  double effector_t_s = 0;  ///< that time; the picture's without readout_s or effector
  int n_board_tags = 0, n_effector_tags = 0;
  int n_effector_faces = 0;  ///< faces with those tags; at least two make the pose well determined
  double noise = 0;          ///< SD, gray levels of 255
  double blur_px = 0;        ///< SD of the board's edges, in linear light; 0 without the board
  /// Tags of a second print with the board's or the effector's numbers. While both are followed,
  /// one quarter of the picture is searched for them at a time, and earlier findings in the other
  /// quarters remain.
  int n_foreign_tags = 0;
  /// RMS distance of measured tag edges from the pose's.
  double board_reprojection_px = 0, effector_reprojection_px = 0;
  /// Confidence in the effector's pose (the board's without an effector), 0...1: the fraction of
  /// pixels around its tags' edges that match an edge. Halved where two poses fit about equally
  /// well, at a reprojection error of 1 pixel, and where the standard deviation of the effector's
  /// position is 0.5 mm, as from a single slanted tag, or that of its farthest tag corner 2 mm, as
  /// for two similar tilts; below one half where the picture is overexposed. 0 if nothing was
  /// found, never between that and least_pose_quality.
  double quality = 0;
  /// The picture repeats the last one: poses and effector_t_s are the last one's.
  bool repeated = false;
  /// Fraction of the last picture in each, by the camera's temporal denoising; removed before tags
  /// are measured.
  double last_picture = 0;
  /// Focal length relative to the camera's file: it changes with a lens that refocuses.
  double focal_length_scale = 1;
  /// Excess of the size of the board's tags over the file's, relative to the distances between
  /// them; 0 unless it is certain. The tracker uses it.
  double board_tag_excess = 0;
  /// The effector is beyond the reach of motion since it was last seen, or was not seen for too
  /// long.
  bool jump = false;
  /// Outward displacement of the board's tag edges (negative: black tags look smaller) that remains
  /// after correction by the learned tone curve.
  double edge_bias_px = 0;
  TrackerTimes times;
};

/// Not thread-safe: use one tracker per thread.
class Tracker {
 public:
  /// @throws Error for a board without tags, an unknown tag family or id, or a tag that is on both
  /// bodies
  explicit Tracker(const Apparatus& apparatus, const TrackerSettings& settings = {});

  /// @param t_s the picture's capture time; times increase
  /// @throws Error if the picture does not have the calibration's size
  TrackedPicture track(const Image& image, double t_s);

  /// The current estimate of the camera's tone curve: the camera file's response, updated by the
  /// pictures since.
  const ToneCurve& tone() const { return tone_.curve(); }
  /// Whether pictures have contributed to it; the result may be sRGB.
  bool has_tone_evidence() const { return tone_.has_evidence(); }

  /// Discards the last poses: the next picture does not continue them. Keeps the tone curve.
  void reset();

 private:
  bool has_effector() const { return !effector_.body().tags.empty(); }
  std::vector<DetectedTag> detect(TagDetector& detector, const Region& region,
                                  EdgeSearch search = EdgeSearch::above_noise);
  const std::vector<DetectedTag>& all_board_tags();
  std::vector<DetectedTag> all_effector_tags();
  std::optional<BodyFit> find_board();
  std::optional<BodyFit> learn_tag_size(std::optional<BodyFit> board);
  std::optional<BodyFit> learn_tone(std::optional<BodyFit> board);
  std::optional<BodyFit> learn_focus(std::optional<BodyFit> board, double t_s);
  void refocus();
  void expect_picture();
  std::optional<BodyFit> find_effector(const BodyFit& seen_board, double t_s);
  std::optional<Smear> smear(const Pose& board_from_effector, const BodyFit& seen_board,
                             double t_s) const;
  BodyFit unrolled(BodyFit fit, const BodyFit& seen_board, const BiasPrior& prior, double t_s);
  TrackedPicture repeated();
  Velocity unroll(BodyFit& fit, const BodyFit& seen_board, const BiasPrior& prior, double t_s);
  int doubles_in(const Region& part, const std::optional<BodyFit>& effector);
  void look_for_doubles(const std::optional<BodyFit>& effector);
  void take_board(const std::optional<BodyFit>& fit);
  void take_effector(const BodyFit& fit, double t_s);

  Intrinsics calibrated_, camera_;  ///< the file's, and with its focal length of now
  TrackerSettings settings_;
  BodyFinder board_, effector_;
  MarkerBody board_of_file_;
  TagSizeLearner tag_size_;
  ToneLearner tone_;
  TemporalMix mix_;
  FocusLearner focus_;
  std::vector<TagDetector> detectors_;  ///< one, or the board's and the effector's

  // Of the current picture:
  Image gray_;
  std::optional<std::vector<DetectedTag>> board_family_tags_;
  TrackedPicture result_;
  int n_intervals_ = 1;  ///< between pictures since the last one: more if the times miss lost ones

  // Of previous pictures:
  std::optional<Pose> last_board_;
  int last_n_board_tags_ = 0;
  int n_without_board_ = 0;  ///< number of pictures
  std::optional<SeenEffector> seen_;
  int n_unseen_ = 0;              ///< pictures since then, or since the start
  std::array<int, 4> doubles_{};  ///< in the quarters of the picture, when they were last searched
  int n_followed_ = 0;            ///< pictures that were not searched completely
};

// Diagnosis of pictures without a board or an effector.

/// Describes why the body was not found: dark, white, mirrored, with other tags, without any. Takes
/// as long as several detections.
/// @param what name of the body  @param beside the other body, which may be in the picture, too
std::string why_unseen(const Image& picture, const MarkerBody& body, const std::string& what,
                       const MarkerBody& beside = {});

}  // namespace heft
