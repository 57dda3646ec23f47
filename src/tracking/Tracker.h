// From pixels to poses: finds the board's and the effector's tags, measures their edges on linear
// light, and solves for both poses. Unfiltered: PoseFilter.h smooths.
#pragma once

#include <memory>
#include <optional>

#include "base/Image.h"
#include "base/PoseTypes.h"
#include "tracking/MarkerBody.h"

namespace heft {

struct TrackerSettings {
  /// Detection on a picture smaller by this factor; 0: 1 up to 800 pixels wide, 1.5 above.
  double decimate = 0;
  bool refine_edges = true;  ///< false: the detector's own corners
  bool remove_bias = true;   ///< the edge bias that blur and the tone curve cause
  /// Look where things were in the last picture, and everywhere only when they are not there.
  bool region_of_interest = true;
  double least_quality = 0.85;  ///< of a tag's edges, 0...1
};

/// Where the time of a picture went, seconds.
struct TrackerTimes {
  double detect_s = 0, refine_s = 0, pose_s = 0;
};

struct TrackedPicture {
  std::optional<Pose> camera_from_board;
  std::optional<Pose> board_from_effector;  ///< only with the board
  int n_board_tags = 0, n_effector_tags = 0;
  int n_effector_faces = 0;  ///< on which those tags are; two make a pose firm
  /// RMS distance of the measured tag edges from where the pose puts them.
  double board_reprojection_px = 0, effector_reprojection_px = 0;
  /// 0...1: how far the effector's pose can be trusted (the board's where there is no effector):
  /// the fraction of pixels around its tags' edges that look like edges; halved where two poses fit
  /// about equally well, where the reprojection error is 1 pixel, and where its tags leave the
  /// effector's place open by half a millimeter, as a single slanted one may; less than half where
  /// the picture is overexposed.
  double quality = 0;
  /// The effector is not where motion could have taken it since it was last seen, or was not seen
  /// for so long that nothing can be said.
  bool jump = false;
  double edge_bias_px = 0;  ///< of the board's tags, outwards; black tags that look small: negative
  TrackerTimes times;
};

/// One tracker is used by one thread.
class Tracker {
 public:
  /// @throws Error for a board without tags, a family that the detector does not have, an id that a
  ///   family does not have, or a tag that is on both bodies
  explicit Tracker(const Apparatus& apparatus, const TrackerSettings& settings = {});
  ~Tracker();
  Tracker(Tracker&&) noexcept;
  Tracker& operator=(Tracker&&) noexcept;

  /// @param t_s the picture's capture time; times increase
  /// @throws Error when the picture is not of the size that the camera was calibrated for
  TrackedPicture track(const Image& image, double t_s);

  /// Forgets the last poses: what comes next is no continuation.
  void reset();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace heft
