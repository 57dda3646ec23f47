#include "apparatus/sources/FilmedPictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/Error.h"
#include "base/Random.h"
#include "protocol/readers/Files.h"

namespace heft {

namespace {
// An arm over the board for a moment does not lose it.
constexpr double board_patience_s = 0.5;
// A camera without a picture for this long is lost: about seven pictures at 15 Hz.
constexpr double silence_s = 0.5;

SyntheticSettings settings_for(const PictureParts& parts) {
  SyntheticSettings settings = parse_synthetic_camera(parts.settings, parts.what);
  double& exposure_s = settings.optics.exposure_s;
  const double rate_hz = parts.protocol.display_rate_hz;
  // The default exposure is shortened for a fast display.
  if (parts.what.empty()) exposure_s = std::min(exposure_s, 0.5 / rate_hz);
  if (exposure_s > 1 / rate_hz)
    throw Error(fmt::format("{}: exposure_s is {} s, but at the protocol's {} pictures a second "
                            "each lasts {:.4g} s; expected at most that",
                            parts.what, exposure_s, rate_hz, 1 / rate_hz),
                ExitCode::invalid_file);
  settings.left_hand = parts.left_hand;
  settings.motion_samples = 1;  // more only if something moves
  return settings;
}
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
  sample_ = {};
  camera_from_board_.reset();
  look_again();
}

Picture PictureTracker::track(std::shared_ptr<const Image> image, double t_s) {
  const TrackedPicture tracked = tracker_.track(*image, t_s);
  Picture picture;
  picture.camera = std::move(image);
  picture.quality = tracked.quality;
  picture.doubled = tracked.n_foreign_tags > 0;
  if (!board_seen_s_) board_seen_s_ = t_s;
  if (tracked.camera_from_board) {
    camera_from_board_ = tracked.camera_from_board;
    board_seen_s_ = t_s;
  } else if (t_s - *board_seen_s_ > board_patience_s) {
    picture.trouble = "board_lost";
  }
  picture.camera_from_board = camera_from_board_;
  if (!tracked.repeated) sample_ = smoothed(filter_, tracked, t_s);
  picture.sample = sample_;
  picture.sample.t_capture_s = t_s;
  picture.sample.jump = sample_.jump && !tracked.repeated;
  return picture;
}

CameraPictures::CameraPictures(OpenCamera open, const PictureParts& parts)
    : open_(std::move(open)),
      camera_(open_()),
      apparatus_(parts.apparatus),
      tracker_(parts.apparatus),
      clock_(parts.clock) {
  if (!parts.record_to.empty()) recording_.emplace(parts.record_to);
}

void CameraPictures::begin_attempt(const AttemptStart& attempt) {
  attempt_ = attempt;
  attempt_capture_s_ = last_capture_s_;
  restart_count();  // pictures between attempts do not count
}

void CameraPictures::restart_count() {
  last_picture_s_ = clock_.now_s();
  last_number_.reset();
  tracker_.look_again();
}

std::optional<double> CameraPictures::rate_hz() const {
  const double reported_hz = camera_->mode().rate_hz;
  return std::isfinite(reported_hz) && reported_hz > 0 ? std::optional(reported_hz) : std::nullopt;
}

std::optional<Picture> CameraPictures::next() {
  auto taken = camera_->next(0);
  if (!taken) return camera_->is_live() ? lost_picture() : std::nullopt;
  const double t_s = time_of(*taken);
  const int n_dropped = last_number_ ? static_cast<int>(taken->number - *last_number_ - 1) : 0;
  last_number_ = taken->number;
  last_picture_s_ = clock_.now_s();
  if (recording_ && attempt_.is_recorded()) recording_->keep(taken->image, taken->capture_s);
  Picture picture =
      tracker_.track(std::make_shared<const Image>(std::move(taken->image)), taken->capture_s);
  if (t_s < 0) return std::nullopt;  // taken before the attempt
  picture.sample.t_capture_s = t_s;
  picture.n_dropped = n_dropped;
  return picture;
}

std::vector<CheckResult> CameraPictures::check(double wanted_rate_hz) {
  if (camera_->is_live()) return check_camera(*camera_, apparatus_, wanted_rate_hz);
  return check_camera(*open_(), apparatus_, wanted_rate_hz);
}

// Time since the attempt's start.
double CameraPictures::time_of(const CameraPicture& taken) {
  last_capture_s_ = taken.capture_s;
  if (camera_->is_live()) return clock_.session_s(taken.capture_s) - attempt_.start_s;
  if (!attempt_capture_s_) attempt_capture_s_ = taken.capture_s;
  return taken.capture_s - *attempt_capture_s_;
}

std::optional<Picture> CameraPictures::lost_picture() {
  const double now_s = clock_.now_s();
  if (now_s - last_picture_s_ < silence_s) return std::nullopt;
  Picture picture;
  picture.trouble = "camera_lost";
  picture.sample.tracked = false;
  picture.sample.t_capture_s = now_s - attempt_.start_s;
  return picture;
}

SyntheticPictures::SyntheticPictures(const PictureParts& parts)
    : hand_(parts.hand),
      apparatus_(parts.apparatus),
      settings_(settings_for(parts)),
      camera_(parts.apparatus, settings_, RandomStream(parts.seed, "camera").bits()),
      tracker_(parts.apparatus),
      count_(parts.protocol.display_rate_hz) {
  if (!parts.record_to.empty()) recording_.emplace(parts.record_to);
}

// Each attempt restarts the camera, so that one interrupted by a crash is repeated exactly.
void SyntheticPictures::begin_attempt(const AttemptStart& attempt) {
  attempt_ = attempt;
  count_.restart();
  camera_.restart();
  tracker_.reset();
}

void SyntheticPictures::restart_count() {
  count_.skipped();
  tracker_.look_again();
}

std::optional<Picture> SyntheticPictures::next() {
  const auto number_of = [&](std::uint64_t count) {
    return (static_cast<std::uint64_t>(attempt_.trial_number) << 40) |
           (static_cast<std::uint64_t>(attempt_.attempt) << 32) | count;
  };
  std::uint64_t count = count_.take();
  int n_lost = 0;
  for (; camera_.drops(number_of(count)); count = count_.take()) ++n_lost;
  const double t_s = count_.time_s(count);
  const std::uint64_t number = number_of(count);
  const auto path = [&](double at_s) -> std::optional<Pose> {
    const HandSample sample = hand_.hand(std::max(at_s, 0.0));
    return sample.in_view ? std::optional(sample.pose) : std::nullopt;
  };
  auto image = std::make_shared<const Image>(camera_.picture(path, t_s, number));
  if (recording_ && attempt_.is_recorded())
    recording_->keep(*image, attempt_.start_s + t_s, {path(t_s), settings_.camera_from_board});
  Picture picture = tracker_.track(std::move(image), t_s);
  picture.n_dropped = count_.skipped() + n_lost;
  return picture;
}

// The checks of a real camera, with the effector held still over the board.
std::vector<CheckResult> SyntheticPictures::check(double wanted_rate_hz) {
  constexpr std::uint64_t n_looked_at = 15;
  const auto held = [](double) -> std::optional<Pose> {
    return Pose{{0, -0.04, 0.06}, Eigen::Quaterniond::Identity()};
  };
  ApparatusCheck check(apparatus_);
  for (std::uint64_t i = 0; i < n_looked_at; ++i) {
    const double t_s = static_cast<double>(i) / wanted_rate_hz;
    check.see({camera_.picture(held, t_s, i), t_s, static_cast<std::int64_t>(i), ""}, -1);
  }
  const Intrinsics& camera = apparatus_.camera;
  return check.results({camera.width_px, camera.height_px, wanted_rate_hz, "(rendered)", {}, {}},
                       wanted_rate_hz, false);
}

}  // namespace heft
