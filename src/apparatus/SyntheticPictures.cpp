#include "apparatus/SyntheticPictures.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/Error.h"
#include "base/Random.h"
#include "protocol/SyntheticCameraFile.h"

namespace heft {

namespace {
SyntheticSettings settings_for(const PictureParts& parts) {
  SyntheticSettings settings = parse_synthetic_camera(parts.settings, parts.what);
  double& exposure_s = settings.optics.exposure_s;
  const double rate_hz = parts.protocol.display_rate_hz;
  // The usual one gives way to a fast display.
  if (parts.what.empty()) exposure_s = std::min(exposure_s, 0.5 / rate_hz);
  if (exposure_s > 1 / rate_hz)
    throw Error(fmt::format("{}: exposure_s is {} s, but at the protocol's {} pictures a second "
                            "each lasts {:.4g} s, expected at most that",
                            parts.what, exposure_s, rate_hz, 1 / rate_hz),
                ExitCode::invalid_file);
  settings.motion_samples = 1;  // more only where something moves
  return settings;
}
}  // namespace

SyntheticPictures::SyntheticPictures(const PictureParts& parts)
    : hand_(parts.hand),
      apparatus_(parts.apparatus),
      settings_(settings_for(parts)),
      camera_(parts.apparatus, settings_, RandomStream(parts.seed, "camera").bits()),
      tracker_(parts.apparatus),
      count_(parts.protocol.display_rate_hz) {
  if (!parts.record_to.empty()) recording_.emplace(parts.record_to);
}

// Every attempt's pictures are its own, so that one that a crash cut short runs again exactly.
void SyntheticPictures::begin_attempt(const AttemptStart& attempt) {
  attempt_ = attempt;
  count_.restart();
  tracker_.reset();
}

void SyntheticPictures::listen_anew() {
  count_.skipped();
  tracker_.look_anew();
}

std::optional<Picture> SyntheticPictures::next() {
  const std::uint64_t count = count_.take();
  const double t_s = count_.time_s(count);
  const auto number = (static_cast<std::uint64_t>(attempt_.trial_number) << 40) |
                      (static_cast<std::uint64_t>(attempt_.attempt) << 32) | count;
  const auto path = [&](double at_s) -> std::optional<Pose> {
    const HandSample sample = hand_.hand(std::max(at_s, 0.0));
    return sample.in_view ? std::optional(sample.pose) : std::nullopt;
  };
  auto image = std::make_shared<const Image>(camera_.picture(path, t_s, number));
  if (recording_)
    recording_->keep(*image, attempt_.start_s + t_s, {path(t_s), settings_.camera_from_board});
  Picture picture = tracker_.track(std::move(image), t_s);
  picture.n_dropped = count_.skipped();
  return picture;
}

// As of a real camera, with the effector held still over the board.
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
