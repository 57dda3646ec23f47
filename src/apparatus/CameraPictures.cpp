#include "apparatus/CameraPictures.h"

#include <cmath>

namespace heft {

namespace {
// A camera that gives nothing for this long is lost; at 15 pictures a second some seven are
// missing.
constexpr double silence_s = 0.5;
}  // namespace

CameraPictures::CameraPictures(OpenCamera open, const PictureParts& parts)
    : open_(std::move(open)),
      camera_(open_()),
      apparatus_(parts.apparatus),
      tracker_(parts.apparatus),
      clock_(parts.clock) {
  if (!parts.record_to.empty()) recording_.emplace(parts.record_to);
}

void CameraPictures::begin_attempt(const AttemptStart& attempt) {
  attempt_start_s_ = attempt.start_s;
  attempt_capture_s_ = last_capture_s_;
  listen_anew();  // nobody listened between attempts
}

void CameraPictures::listen_anew() {
  heard_s_ = clock_.now_s();
  last_number_.reset();
  tracker_.look_anew();
}

std::optional<double> CameraPictures::rate_hz() const {
  const double told_hz = camera_->mode().rate_hz;
  return std::isfinite(told_hz) && told_hz > 0 ? std::optional(told_hz) : std::nullopt;
}

std::optional<Picture> CameraPictures::next() {
  auto taken = camera_->next(0);
  if (!taken) return camera_->is_live() ? picture_of_silence() : std::nullopt;
  const double t_s = time_of(*taken);
  const int n_dropped = last_number_ ? static_cast<int>(taken->number - *last_number_ - 1) : 0;
  last_number_ = taken->number;
  heard_s_ = clock_.now_s();
  if (recording_) recording_->keep(taken->image, taken->capture_s);
  Picture picture =
      tracker_.track(std::make_shared<const Image>(std::move(taken->image)), taken->capture_s);
  if (t_s < 0) return std::nullopt;  // taken before the attempt started
  picture.sample.t_capture_s = t_s;
  picture.n_dropped = n_dropped;
  return picture;
}

std::vector<CheckResult> CameraPictures::check(double wanted_rate_hz) {
  if (camera_->is_live()) return check_camera(*camera_, apparatus_, wanted_rate_hz);
  return check_camera(*open_(), apparatus_, wanted_rate_hz);
}

// Since the attempt's start.
double CameraPictures::time_of(const CameraPicture& taken) {
  last_capture_s_ = taken.capture_s;
  if (camera_->is_live()) return clock_.session_s(taken.capture_s) - attempt_start_s_;
  if (!attempt_capture_s_) attempt_capture_s_ = taken.capture_s;
  return taken.capture_s - *attempt_capture_s_;
}

std::optional<Picture> CameraPictures::picture_of_silence() {
  const double now_s = clock_.now_s();
  if (now_s - heard_s_ < silence_s) return std::nullopt;
  Picture picture;
  picture.trouble = "camera_lost";
  picture.sample.tracked = false;
  picture.sample.t_capture_s = now_s - attempt_start_s_;
  return picture;
}

}  // namespace heft
