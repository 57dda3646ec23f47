#include "session/ApparatusCheck.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

#include "base/Clock.h"

namespace heft {

namespace {
constexpr int n_wanted = 45;      // pictures; three seconds at the paper's rate
constexpr double patience_s = 1;  // for one picture
constexpr double jitter_limit_m = 0.0002;
constexpr double detected_share = 0.95;

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  const auto place = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + place, values.end());
  return values[static_cast<std::size_t>(place)];
}

double mean(const std::vector<double>& values) {
  return values.empty() ? 0
                        : std::accumulate(values.begin(), values.end(), 0.0) /
                              static_cast<double>(values.size());
}

// The first channel is enough: tags and paper are gray.
void look_at_light(const Image& image, std::vector<double>& brightness,
                   std::vector<double>& saturated) {
  std::vector<double> values;
  std::size_t n_white = 0;
  const auto step = static_cast<std::size_t>(image.channels) * 7;
  for (std::size_t i = 0; i < image.pixels.size(); i += step) {
    values.push_back(image.pixels[i]);
    n_white += image.pixels[i] >= 254 ? 1 : 0;
  }
  brightness.push_back(quantile(values, 0.5));
  saturated.push_back(static_cast<double>(n_white) / static_cast<double>(values.size()));
}
}  // namespace

std::string to_json(const CheckResult& result) {
  return nlohmann::ordered_json{
      {"name", result.name}, {"verdict", name_of(result.verdict)}, {"finding", result.finding}}
      .dump();
}

void ApparatusCheck::see(const CameraPicture& picture, double waited_s) {
  times_s_.push_back(picture.capture_s);
  if (waited_s >= 0) waited_s_.push_back(waited_s);
  look_at_light(picture.image, brightness_, saturated_);
  const TrackedPicture tracked = tracker_.track(picture.image, picture.capture_s);
  tracked_in_s_.push_back(tracked.times.detect_s + tracked.times.refine_s + tracked.times.pose_s);
  tracked_.push_back(tracked);
}

std::vector<CheckResult> ApparatusCheck::results(const CameraMode& mode, double wanted_rate_hz,
                                                 bool live) const {
  std::vector<CheckResult> all;
  all.push_back({tracked_.empty() ? Verdict::failed : Verdict::ok, "camera",
                 tracked_.empty()
                     ? std::string("it gives no pictures; is the cable in, does another program "
                                   "use it?")
                     : fmt::format("{} x {} pixels {}, {} pictures looked at", mode.width_px,
                                   mode.height_px, mode.pixel_format, tracked_.size())});
  if (tracked_.empty()) return all;
  if (live) {
    for (const std::string& what : mode.locked) all.push_back({Verdict::ok, "locked", what});
    for (const std::string& what : mode.not_locked)
      all.push_back({Verdict::warning, "not locked", what});
    all.push_back(rate(wanted_rate_hz));
    all.push_back(latency());
  }
  all.push_back(light());
  all.push_back(print_scale());
  all.push_back(board());
  all.push_back(board_jitter());
  if (!apparatus_.effector.tags.empty()) all.push_back(effector());
  all.push_back(detection_time(wanted_rate_hz));
  return all;
}

CheckResult ApparatusCheck::rate(double wanted_rate_hz) const {
  if (times_s_.size() < 2) return {Verdict::failed, "frame rate", "only one picture came"};
  std::vector<double> gaps_s;
  for (std::size_t i = 1; i < times_s_.size(); ++i) gaps_s.push_back(times_s_[i] - times_s_[i - 1]);
  const double rate_hz = 1 / mean(gaps_s);
  const std::string figure = fmt::format("{:.1f} pictures a second, longest gap {:.0f} ms", rate_hz,
                                         1000 * quantile(gaps_s, 1));
  if (rate_hz > 0.95 * wanted_rate_hz) return {Verdict::ok, "frame rate", figure};
  return {Verdict::failed, "frame rate",
          fmt::format("{}; the protocol shows {:g}: more light or a shorter exposure, another USB "
                      "port, or a lower display_rate_hz",
                      figure, wanted_rate_hz)};
}

CheckResult ApparatusCheck::latency() const {
  const double median_s = quantile(waited_s_, 0.5);
  const std::string figure = fmt::format(
      "a picture is there {:.0f} ms after it was taken (95 %: "
      "{:.0f} ms)",
      1000 * median_s, 1000 * quantile(waited_s_, 0.95));
  return {median_s < 0.1 ? Verdict::ok : Verdict::warning, "latency", figure};
}

CheckResult ApparatusCheck::light() const {
  const double level = mean(brightness_), white = mean(saturated_);
  const std::string figure =
      fmt::format("median brightness {:.0f} of 255, {:.1f} % of pixels white", level, 100 * white);
  if (white > 0.02)
    return {Verdict::warning, "light",
            figure + "; overexposed paper makes tags look small: less light or a shorter exposure"};
  if (level < 40) return {Verdict::warning, "light", figure + "; too dark: more light"};
  return {Verdict::ok, "light", figure};
}

CheckResult ApparatusCheck::print_scale() const {
  const auto& measured_m = apparatus_.board.measured_ruler_m;
  if (!measured_m)
    return {Verdict::warning, "print scale",
            "not measured: measure the sheet's 150 mm ruler and write its length in meters as "
            "ruler_measured_m into the board's file; half a percent of scale is 2 mm of pose"};
  return {Verdict::ok, "print scale",
          fmt::format("the ruler was measured as {:.2f} mm", 1000 * *measured_m)};
}

CheckResult ApparatusCheck::board() const {
  const auto found = std::ranges::count_if(
      tracked_, [](const TrackedPicture& t) { return t.camera_from_board.has_value(); });
  std::vector<double> n_tags, error_px;
  for (const TrackedPicture& tracked : tracked_)
    if (tracked.camera_from_board) {
      n_tags.push_back(tracked.n_board_tags);
      error_px.push_back(tracked.board_reprojection_px);
    }
  const double share = static_cast<double>(found) / static_cast<double>(tracked_.size());
  const std::string figure = fmt::format(
      "seen in {:.0f} % of pictures, {:.0f} of {} tags, reprojection error {:.2f} px", 100 * share,
      quantile(n_tags, 0.5), apparatus_.board.tags.size(), quantile(error_px, 0.5));
  if (found == 0)
    return {Verdict::failed, "board",
            "not seen in any picture: is it in view, and is this its file?"};
  if (share < detected_share)
    return {Verdict::failed, "board", figure + "; put it wholly in view, check light and focus"};
  if (quantile(error_px, 0.5) > 0.5)
    return {Verdict::warning, "board",
            figure + "; the camera's calibration or the board's file does not fit"};
  return {Verdict::ok, "board", figure};
}

CheckResult ApparatusCheck::board_jitter() const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero(), squares = Eigen::Vector3d::Zero();
  int n = 0;
  for (const TrackedPicture& tracked : tracked_)
    if (tracked.camera_from_board) {
      const Eigen::Vector3d& at = tracked.camera_from_board->position_m;
      sum += at;
      squares += at.cwiseProduct(at);
      ++n;
    }
  if (n < 2) return {Verdict::failed, "jitter", "too few pictures of the board"};
  const Eigen::Vector3d middle = sum / n;
  const double sd_m = std::sqrt(std::max(0.0, (squares / n - middle.cwiseProduct(middle)).sum()));
  const std::string figure = fmt::format("the board's pose varies by {:.3f} mm", 1000 * sd_m);
  if (sd_m < jitter_limit_m) return {Verdict::ok, "jitter", figure};
  return {Verdict::warning, "jitter", figure + "; does the camera or the table move?"};
}

CheckResult ApparatusCheck::effector() const {
  const auto found = std::ranges::count_if(
      tracked_, [](const TrackedPicture& t) { return t.board_from_effector.has_value(); });
  return {Verdict::ok, "effector",
          fmt::format("seen in {:.0f} % of pictures (hold it in view to try)",
                      100.0 * static_cast<double>(found) / static_cast<double>(tracked_.size()))};
}

CheckResult ApparatusCheck::detection_time(double wanted_rate_hz) const {
  const double p95_s = quantile(tracked_in_s_, 0.95);
  const std::string figure = fmt::format("{:.1f} ms a picture (95 %: {:.1f} ms)",
                                         1000 * quantile(tracked_in_s_, 0.5), 1000 * p95_s);
  if (p95_s < 0.5 / wanted_rate_hz) return {Verdict::ok, "detection", figure};
  return {Verdict::warning, "detection",
          figure + "; this machine is slow for these pictures: a smaller camera mode"};
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
