#include "session/SyntheticPictures.h"

#include "base/Random.h"

namespace heft {

namespace {
SyntheticSettings settings_for(const Protocol& protocol) {
  SyntheticSettings settings;
  // A slow display's camera could, but a lab's should not, expose longer.
  settings.optics.exposure_s = std::min(settings.optics.exposure_s, 0.5 / protocol.display_rate_hz);
  settings.motion_samples = 1;  // more only where something moves
  return settings;
}
}  // namespace

SyntheticPictures::SyntheticPictures(const PictureParts& parts)
    : hand_(parts.hand),
      apparatus_(parts.apparatus),
      camera_(parts.apparatus, settings_for(parts.protocol),
              RandomStream(parts.seed, "camera").bits()),
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
  if (recording_) recording_->keep(*image, attempt_.start_s + t_s);
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
