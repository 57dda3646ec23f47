#include "apparatus/checks/ApparatusCheck.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/Clock.h"
#include "protocol/Protocol.h"
#include "tracking/Tracker.h"

namespace heft {

namespace {
constexpr int n_wanted = 45;      // pictures; three seconds at the paper's rate
constexpr double patience_s = 1;  // for one picture

// A typical trial: three cubes on the table.
ViewSetup usual_view(const Intrinsics& camera) {
  ViewSetup setup;
  setup.stage = stage_of(Protocol{}, 3);
  setup.camera = camera;
  return setup;
}

ViewFrame usual_frame(const CameraPicture& picture, const TrackedPicture& tracked) {
  ViewFrame shown;
  shown.camera = std::make_shared<const Image>(picture.image);
  shown.camera_from_board = tracked.camera_from_board;
  shown.frame.tracked = tracked.board_from_effector.has_value();
  shown.frame.clone = tracked.board_from_effector;
  for (const Eigen::Vector3d& slot_m : stage_of(Protocol{}, 3).slots_m)
    shown.frame.cubes.push_back({slot_m, Eigen::Quaterniond::Identity()});
  return shown;
}

// One channel is enough, because tags and paper are gray.
void look_at_light(const Image& image, LookedAt& seen) {
  std::vector<std::uint8_t> values;
  const auto step = static_cast<std::size_t>(image.channels) * 7;
  for (std::size_t i = 0; i < image.pixels.size(); i += step) values.push_back(image.pixels[i]);
  if (values.empty()) return;
  const auto n_white = std::ranges::count_if(values, [](std::uint8_t v) { return v >= 254; });
  seen.white_fraction = static_cast<double>(n_white) / static_cast<double>(values.size());
  std::ranges::nth_element(values, values.begin() + static_cast<long>(values.size() / 2));
  seen.brightness = values[values.size() / 2];
}

CheckResult camera_verdict(const CameraMode& mode, int n_pictures) {
  if (n_pictures == 0)
    return {
        CheckVerdict::failed, "camera",
        "the camera delivers no pictures; check its cable, and whether another program uses it"};
  return {CheckVerdict::ok, "camera",
          fmt::format("{} x {} pixels{}{}, {} pictures examined", mode.width_px, mode.height_px,
                      mode.pixel_format.empty() ? "" : " ", mode.pixel_format, n_pictures)};
}
}  // namespace

std::string to_json(const CheckResult& result) {
  return nlohmann::ordered_json{
      {"name", result.name}, {"verdict", name_of(result.verdict)}, {"finding", result.finding}}
      .dump();
}

ApparatusCheck::ApparatusCheck(const Apparatus& apparatus)
    : apparatus_(apparatus), tracker_(apparatus), drawing_(usual_view(apparatus.camera)) {}

void ApparatusCheck::see(const CameraPicture& picture, double waited_s) {
  LookedAt seen;
  seen.capture_s = picture.capture_s;
  seen.number = picture.number;
  seen.waited_s = waited_s;
  look_at_light(picture.image, seen);
  std::vector<double> light = light_of_blocks(picture.image);
  compare_light(last_light_, light, picture.image.width / light_block_px, seen);
  last_light_ = std::move(light);
  const double began_s = monotonic_s();
  seen.tracked = tracker_.track(picture.image, picture.capture_s);
  seen.tracked_in_s = monotonic_s() - began_s;
  const ViewFrame shown = usual_frame(picture, seen.tracked);
  const double draw_s = monotonic_s();
  drawing_.draw(shown);
  seen.drawn_in_s = monotonic_s() - draw_s;
  pictures_.push_back(std::move(seen));
  last_ = picture.image;
}

std::vector<CheckResult> ApparatusCheck::results(const CameraMode& mode, double wanted_rate_hz,
                                                 bool live) const {
  std::vector<CheckResult> all{camera_verdict(mode, n_pictures())};
  if (pictures_.empty()) return all;
  if (live) {
    std::ranges::move(lock_verdicts(mode), std::back_inserter(all));
    all.push_back(rate_verdict(pictures_, wanted_rate_hz));
  }
  all.push_back(light_verdict(pictures_));
  all.push_back(noise_verdict(pictures_));
  for (const auto verdict : {ghosting_verdict, flicker_verdict, gain_verdict, lost_verdict})
    all.push_back(verdict(pictures_));
  all.push_back(doubles_verdict(pictures_));
  all.push_back(print_scale_verdict(apparatus_.board, "print scale", "board"));
  const auto never = [&](std::optional<Pose> TrackedPicture::*pose) {
    return std::ranges::none_of(
        pictures_, [&](const LookedAt& seen) { return (seen.tracked.*pose).has_value(); });
  };
  const bool no_board = never(&TrackedPicture::camera_from_board);
  const auto why = [&](bool is_asked, const MarkerBody& body, const char* what,
                       const MarkerBody& beside) {
    return is_asked ? why_unseen(last_, body, what, beside) : "";
  };
  all.push_back(board_verdict(pictures_, apparatus_.board,
                              why(no_board, apparatus_.board, "board", apparatus_.effector)));
  if (!no_board) all.push_back(tag_size_verdict(pictures_));
  if (!no_board) all.push_back(tone_verdict(apparatus_.camera, tracker_.tone()));
  if (!no_board) all.push_back(sharpness_verdict(pictures_));
  if (!no_board) all.push_back(breathing_verdict(pictures_));
  all.push_back(jitter_verdict(pictures_));
  if (!apparatus_.effector.tags.empty()) {
    all.push_back(print_scale_verdict(apparatus_.effector, "effector scale", "effector"));
    const bool no_effector = !no_board && never(&TrackedPicture::board_from_effector);
    all.push_back(effector_verdict(
        pictures_, why(no_effector, apparatus_.effector, "effector", apparatus_.board)));
  }
  all.push_back(latency_verdict(pictures_));
  all.push_back(speed_verdict(pictures_, apparatus_.camera, wanted_rate_hz));
  return all;
}

std::vector<CheckResult> check_camera(Camera& camera, const Apparatus& apparatus,
                                      double wanted_rate_hz) {
  ApparatusCheck check(apparatus);
  while (check.n_pictures() < n_wanted) {
    const auto picture = camera.next(patience_s);
    if (!picture) break;
    check.see(*picture, camera.is_live() ? monotonic_s() - picture->capture_s : -1);
  }
  return check.results(camera.mode(), wanted_rate_hz, camera.is_live());
}

}  // namespace heft
