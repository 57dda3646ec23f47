#include "apparatus/sources/DraggedPictures.h"

#include "base/Error.h"
#include "base/Pose.h"
#include "base/Random.h"

namespace heft {

namespace {
SyntheticSettings without_hand() {
  SyntheticSettings settings;
  settings.hand = false;
  return settings;
}
}  // namespace

DraggedPictures::DraggedPictures(const PictureParts& parts)
    : effector_(parts.dragged),
      settings_(without_hand()),
      camera_(parts.apparatus, settings_, RandomStream(parts.seed, "camera").bits()),
      clock_(parts.clock),
      count_(parts.protocol.display_rate_hz) {
  if (!effector_)
    throw Error("tracker \"mouse\" needs a window to drag the effector in", ExitCode::usage);
  if (!parts.record_to.empty()) recording_.emplace(parts.record_to);
}

// The effector stays in place between attempts, as a real one would.
void DraggedPictures::begin_attempt(const AttemptStart& attempt) {
  attempt_ = attempt;
  count_.restart();
  last_.reset();
}

// The next position is unknown until its time comes.
std::optional<Picture> DraggedPictures::next() {
  const double now_s = clock_.now_s() - attempt_.start_s;
  if (now_s < count_.next_s()) return std::nullopt;
  count_.take();
  Picture picture;
  picture.n_dropped = count_.skipped();
  TargetSample& sample = picture.sample;
  sample.t_capture_s = now_s;
  sample.pose = effector_->pose;
  if (last_ && now_s > last_->t_capture_s)
    sample.velocity = mean_velocity(last_->pose, sample.pose, now_s - last_->t_capture_s);
  last_ = sample;
  picture.camera = filmed(sample.pose, now_s);
  picture.camera_from_board = settings_.camera_from_board;
  return picture;
}

std::shared_ptr<const Image> DraggedPictures::filmed(const Pose& effector, double t_s) {
  const auto still = [&](double) { return std::optional(effector); };
  auto image = std::make_shared<const Image>(camera_.picture(still, t_s, number_++));
  if (recording_ && attempt_.is_recorded())
    recording_->keep(*image, attempt_.start_s + t_s, {effector, settings_.camera_from_board});
  return image;
}

}  // namespace heft
