// From a camera's picture to what the session needs of it: tracks board and effector, smooths the
// effector's pose without lag, and says when the board is lost.
#pragma once

#include "apparatus/PictureSource.h"
#include "tracking/PoseFilter.h"
#include "tracking/Tracker.h"

namespace heft {

/// What was seen of the effector, smoothed, as Drive wants it.
TargetSample smoothed(PoseFilter& filter, const TrackedPicture& tracked, double t_s);

class PictureTracker {
 public:
  explicit PictureTracker(const Apparatus& apparatus) : tracker_(apparatus) {}

  /// @param t_s of its capture, increasing; Picture::sample has the same time
  Picture track(std::shared_ptr<const Image> image, double t_s);

  /// How long the board is out of view is counted from the next picture on.
  void look_anew() { board_seen_s_.reset(); }

  /// What comes next is no continuation.
  void reset();

 private:
  Tracker tracker_;
  PoseFilter filter_;
  std::optional<Pose> camera_from_board_;
  std::optional<double> board_seen_s_;
};

}  // namespace heft
