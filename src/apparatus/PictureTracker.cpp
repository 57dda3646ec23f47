#include "apparatus/PictureTracker.h"

#include <utility>

namespace heft {

namespace {
// An arm over the board for a moment is no lost board.
constexpr double board_patience_s = 0.5;
}  // namespace

TargetSample smoothed(PoseFilter& filter, const TrackedPicture& tracked, double t_s) {
  TargetSample sample;
  sample.t_capture_s = t_s;
  sample.tracked = tracked.board_from_effector.has_value();
  if (!sample.tracked || tracked.jump) filter.reset();
  if (!sample.tracked) return sample;
  const FilteredPose filtered =
      filter.update(tracked.effector_t_s, *tracked.board_from_effector, tracked.quality);
  sample.pose = filtered.pose;
  sample.velocity = filtered.velocity;
  sample.jump = tracked.jump;
  return sample;
}

void PictureTracker::reset() {
  tracker_.reset();
  filter_.reset();
  camera_from_board_.reset();
  look_anew();
}

Picture PictureTracker::track(std::shared_ptr<const Image> image, double t_s) {
  const TrackedPicture tracked = tracker_.track(*image, t_s);
  Picture picture;
  picture.camera = std::move(image);
  picture.quality = tracked.quality;
  if (!board_seen_s_) board_seen_s_ = t_s;
  if (tracked.camera_from_board) {
    camera_from_board_ = tracked.camera_from_board;
    board_seen_s_ = t_s;
  } else if (t_s - *board_seen_s_ > board_patience_s) {
    picture.trouble = "board_lost";
  }
  picture.camera_from_board = camera_from_board_;
  picture.sample = smoothed(filter_, tracked, t_s);
  return picture;
}

}  // namespace heft
