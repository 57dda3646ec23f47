#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "apparatus/checks/ApparatusCheck.h"
#include "base/math/Quantiles.h"
#include "tracking/calibration/Response.h"

namespace heft {

namespace {
// Limits. A board or effector that is wholly in view, sharp and lit is tracked in every picture;
// below these fractions something obstructs it.
constexpr double expected_fraction = 0.95;
constexpr double expected_two_faces = 0.5;
constexpr double board_limit_px = 0.5;
constexpr double jitter_limit_m = 0.0002;
constexpr double latency_limit_s = 0.1;
constexpr double white_limit = 0.02, dark_limit = 40;
constexpr double plausible_scale = 0.02;  // printers are off by up to 1 %

using Figure = std::function<double(const LookedAt&)>;

std::vector<double> of_all(const Pictures& pictures, const Figure& figure) {
  std::vector<double> values;
  std::ranges::transform(pictures, std::back_inserter(values), figure);
  return values;
}

double quantile_of(const Pictures& pictures, const Figure& figure, double fraction) {
  return quantile(of_all(pictures, figure), fraction).value_or(0);
}

double median(const Pictures& pictures, const Figure& figure) {
  return quantile_of(pictures, figure, 0.5);
}

double fraction_of(const Pictures& pictures, const std::function<bool(const LookedAt&)>& is) {
  return static_cast<double>(std::ranges::count_if(pictures, is)) /
         static_cast<double>(pictures.size());
}

bool has_board(const LookedAt& seen) {
  return seen.tracked.camera_from_board.has_value();
}

bool has_effector(const LookedAt& seen) {
  return seen.tracked.board_from_effector.has_value();
}

bool shows_two_faces(const LookedAt& seen) {
  return seen.tracked.n_effector_faces >= 2;
}

Pictures with_board(const Pictures& pictures) {
  Pictures kept;
  std::ranges::copy_if(pictures, std::back_inserter(kept), has_board);
  return kept;
}

double spent_s(const LookedAt& seen) {
  return seen.tracked_in_s + seen.drawn_in_s;
}

// "exposure 4.0 ms" or "exposure: the camera chooses it...": the control and its state.
CheckResult lock_verdict(CheckVerdict verdict, const std::string& what) {
  for (const char* control :
       {"exposure", "focus", "white balance", "gain", "power line", "dynamic frame rate"}) {
    if (!what.starts_with(control)) continue;
    const auto rest = what.find_first_not_of(": ", std::string(control).size());
    const char* lock = verdict == CheckVerdict::ok ? "locked" : "not locked";
    return {verdict, control,
            rest == std::string::npos ? lock : fmt::format("{}: {}", lock, what.substr(rest))};
  }
  return {verdict, "locks", what};
}
}  // namespace

double expected_time_s(const Intrinsics& camera) {
  constexpr double small_px = 640 * 480, large_px = 1280 * 720, small_s = 0.008, large_s = 0.015;
  const double along =
      (static_cast<double>(camera.width_px) * camera.height_px - small_px) / (large_px - small_px);
  return std::max(small_s, small_s + along * (large_s - small_s));
}

std::vector<CheckResult> lock_verdicts(const CameraMode& mode) {
  std::vector<CheckResult> results;
  for (const std::string& what : mode.locked)
    results.push_back(lock_verdict(CheckVerdict::ok, what));
  for (const std::string& what : mode.not_locked)
    results.push_back(lock_verdict(CheckVerdict::warning, what));
  return results;
}

CheckResult rate_verdict(const Pictures& pictures, double wanted_rate_hz) {
  if (pictures.size() < 2) return {CheckVerdict::failed, "frame rate", "only one picture arrived"};
  std::vector<double> gaps_s;
  for (std::size_t i = 1; i < pictures.size(); ++i)
    gaps_s.push_back(pictures[i].capture_s - pictures[i - 1].capture_s);
  const double rate_hz =
      static_cast<double>(gaps_s.size()) / (pictures.back().capture_s - pictures.front().capture_s);
  const std::string figure = fmt::format("{:.1f} pictures a second, longest gap {:.0f} ms", rate_hz,
                                         1000 * std::ranges::max(gaps_s));
  if (rate_hz > 0.95 * wanted_rate_hz) return {CheckVerdict::ok, "frame rate", figure};
  return {CheckVerdict::failed, "frame rate",
          fmt::format(
              "{}; the protocol displays {:g}: use more light or a shorter exposure, another USB "
              "port, or a lower display_rate_hz",
              figure, wanted_rate_hz)};
}

CheckResult doubles_verdict(const Pictures& pictures) {
  const double doubled =
      fraction_of(pictures, [](const LookedAt& seen) { return seen.tracked.n_foreign_tags > 0; });
  if (doubled == 0) return {CheckVerdict::ok, "doubles", "each tag is in view once"};
  return {
      CheckVerdict::warning, "doubles",
      fmt::format("{:.0f} % of pictures show a second print of a tag (expected none): put spare "
                  "sheets and nets away",
                  100 * doubled)};
}

CheckResult tag_size_verdict(const Pictures& pictures) {
  const double excess = pictures.back().tracked.board_tag_excess;
  if (excess == 0) return {CheckVerdict::ok, "tag size", "the board's tags fit their distances"};
  return {
      CheckVerdict::warning, "tag size",
      fmt::format("the board's tags are {:.2f} % {} than in its file, relative to the distances "
                  "between them; tracking corrects it, better multiply tag_m in the file by "
                  "{:.4f}",
                  100 * std::abs(excess), excess > 0 ? "larger" : "smaller", 1 + excess)};
}

// The limits of blur and noise are twice those of the usual synthetic camera.
CheckResult sharpness_verdict(const Pictures& pictures) {
  constexpr double most_px = 1.2;
  const double blur_px =
      median(with_board(pictures), [](const LookedAt& seen) { return seen.tracked.blur_px; });
  const std::string figure =
      fmt::format("edges are blurred by {:.1f} px (expected {:g} at most)", blur_px, most_px);
  if (blur_px <= most_px) return {CheckVerdict::ok, "sharpness", figure};
  return {CheckVerdict::warning, "sharpness",
          figure + "; focus the lens on the board, and shorten the exposure if things move"};
}

CheckResult noise_verdict(const Pictures& pictures) {
  constexpr double most = 6;
  const double noise = median(pictures, [](const LookedAt& seen) { return seen.tracked.noise; });
  const std::string figure =
      fmt::format("{:.1f} of 255 gray levels (expected {:g} at most)", noise, most);
  if (noise <= most) return {CheckVerdict::ok, "noise", figure};
  return {CheckVerdict::warning, "noise", figure + "; use more light and a lower gain"};
}

CheckResult light_verdict(const Pictures& pictures) {
  const double level = median(pictures, &LookedAt::brightness);
  const double white = median(pictures, &LookedAt::white_fraction);
  const std::string figure =
      fmt::format("median brightness {:.0f} of 255, {:.1f} % of pixels white", level, 100 * white);
  if (white > white_limit)
    return {
        CheckVerdict::warning, "light",
        fmt::format("{} (expected {:.0f} % at most); overexposed paper makes tags look smaller: "
                    "use less light or a shorter exposure",
                    figure, 100 * white_limit)};
  if (level < dark_limit)
    return {
        CheckVerdict::warning, "light",
        fmt::format("{} (expected {:.0f} or more); too dark: use more light", figure, dark_limit)};
  return {CheckVerdict::ok, "light", figure};
}

CheckResult print_scale_verdict(const MarkerBody& body, const char* name, const char* what) {
  if (!body.measured_ruler_m)
    return {
        CheckVerdict::warning, name,
        fmt::format("not measured: measure the 150 mm ruler on the {0}'s sheet and write its "
                    "length in meters as ruler_measured_m into the {0}'s file; an error of 0.5 % "
                    "in scale is 2 mm in pose",
                    what)};
  double off = *body.measured_ruler_m / ruler_m - 1;
  std::string figure = fmt::format("the {}'s ruler was measured as {:.2f} mm ({:+.2f} %)", what,
                                   1000 * *body.measured_ruler_m, 100 * off);
  if (body.measured_across_m) {
    const double across = *body.measured_across_m / ruler_m - 1;
    figure += fmt::format(", across it {:.2f} mm ({:+.2f} %)", 1000 * *body.measured_across_m,
                          100 * across);
    off = std::max(std::abs(off), std::abs(across));
  }
  if (std::abs(off) <= plausible_scale) return {CheckVerdict::ok, name, figure};
  return {CheckVerdict::warning, name,
          fmt::format("{}, expected within {:.0f} %; print at 100 % and check the length", figure,
                      100 * plausible_scale)};
}

CheckResult tone_verdict(const Intrinsics& camera, const ToneCurve& seen) {
  const double bent = brighter_levels(seen, ToneCurve());
  const std::string figure =
      fmt::format("{}: middle grays are {}",
                  std::abs(bent) >= bending_levels ? "the camera bends tones" : "close to sRGB",
                  beside_srgb(bent));
  if (camera.response && std::abs(brighter_levels(seen, response_of(camera))) >= bending_levels)
    return {CheckVerdict::warning, "tones",
            figure +
                "; it differs from the calibration: restore the contrast, gamma and picture mode, "
                "or calibrate again"};
  if (std::abs(bent) < bending_levels) return {CheckVerdict::ok, "tones", figure};
  if (camera.response)
    return {CheckVerdict::ok, "tones",
            figure + "; the camera's file records it, and the tracker compensates it"};
  return {CheckVerdict::warning, "tones",
          figure +
              "; the tracker learns it from the board, but the camera's file lacks it: set a "
              "neutral picture mode (no HDR, no added contrast), or calibrate again, so that the "
              "first picture is right, too"};
}

CheckResult board_verdict(const Pictures& pictures, const MarkerBody& board,
                          const std::string& why) {
  const double fraction = fraction_of(pictures, has_board);
  if (fraction == 0)
    return {CheckVerdict::failed, "board",
            fmt::format("found in 0 of {} pictures: {}", pictures.size(),
                        why.empty() ? "check that it is in view and that this is its file" : why)};
  const Pictures seen = with_board(pictures);
  const double off_px =
      median(seen, [](const LookedAt& l) { return l.tracked.board_reprojection_px; });
  const std::string figure = fmt::format(
      "seen in {:.0f} % of pictures, {:.0f} of {} tags, reprojection error {:.2f} px",
      100 * fraction, median(seen, [](const LookedAt& l) { return l.tracked.n_board_tags; }),
      board.tags.size(), off_px);
  if (fraction < expected_fraction)
    return {CheckVerdict::failed, "board",
            fmt::format("{} (expected {:.0f} %); move it fully into view, check light and focus",
                        figure, 100 * expected_fraction)};
  if (off_px > board_limit_px)
    return {CheckVerdict::warning, "board",
            fmt::format("{} (expected {:g} at most); the camera's calibration or the board's file "
                        "is wrong",
                        figure, board_limit_px)};
  return {CheckVerdict::ok, "board", figure};
}

CheckResult jitter_verdict(const Pictures& pictures) {
  const Pictures seen = with_board(pictures);
  if (seen.size() < 2) return {CheckVerdict::failed, "jitter", "too few pictures of the board"};
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const LookedAt& one : seen) middle += one.tracked.camera_from_board->position_m;
  middle /= static_cast<double>(seen.size());
  double squares_m2 = 0;
  for (const LookedAt& one : seen)
    squares_m2 += (one.tracked.camera_from_board->position_m - middle).squaredNorm();
  const double sd_m = std::sqrt(squares_m2 / static_cast<double>(seen.size()));
  const std::string figure = fmt::format("the board's pose varies by {:.3f} mm (sd)", 1000 * sd_m);
  if (sd_m < jitter_limit_m) return {CheckVerdict::ok, "jitter", figure};
  return {CheckVerdict::warning, "jitter",
          fmt::format("{}, expected {:g} at most; check that camera and table are still", figure,
                      1000 * jitter_limit_m)};
}

// Out of view is not a failure: the effector may have been put down.
CheckResult effector_verdict(const Pictures& pictures, const std::string& why) {
  const double fraction = fraction_of(pictures, has_effector);
  if (fraction == 0)
    return {CheckVerdict::warning, "effector",
            why.empty()
                ? "not seen: hold it in view as in a trial and check again; if it was, check "
                  "its file"
                : fmt::format("found in 0 of {} pictures: hold it in view as in a trial and "
                              "look again; {}",
                              pictures.size(), why)};
  const double firm = fraction_of(pictures, shows_two_faces);
  const std::string figure = fmt::format(
      "seen in {:.0f} % of pictures, two faces or more in {:.0f} %", 100 * fraction, 100 * firm);
  if (fraction < expected_fraction)
    return {
        CheckVerdict::warning, "effector",
        fmt::format(
            "{}, expected {:.0f} % and {:.0f} %: if it was in view all the time, keep fingers off "
            "the tags, and make tags at least 25 pixels wide and sharp",
            figure, 100 * expected_fraction, 100 * expected_two_faces)};
  if (firm >= expected_two_faces) return {CheckVerdict::ok, "effector", figure};
  return {
      CheckVerdict::ok, "effector",
      figure +
          "; one face suffices, but two are more accurate: turn the effector slightly about its "
          "axis, or move the camera to the side, so that an edge between two tags faces it"};
}

CheckResult latency_verdict(const Pictures& pictures) {
  const auto ms = [&](const Figure& figure) { return 1000 * median(pictures, figure); };
  const double drawn_ms = ms(spent_s);
  std::string figure = fmt::format("detect {:.1f}, refine {:.1f}, pose {:.1f}, draw {:.1f} ms",
                                   ms([](const LookedAt& l) { return l.tracked.times.detect_s; }),
                                   ms([](const LookedAt& l) { return l.tracked.times.refine_s; }),
                                   ms([](const LookedAt& l) { return l.tracked.times.pose_s; }),
                                   ms(&LookedAt::drawn_in_s));
  if (pictures.front().waited_s < 0)
    return {CheckVerdict::ok, "latency", figure + "; a file cannot show the camera's latency"};
  const double camera_ms = ms(&LookedAt::waited_s);
  const double all_ms = camera_ms + drawn_ms;
  figure = fmt::format("camera {:.0f} ms (95 %: {:.0f}), {}; {:.0f} ms from light to drawn picture",
                       camera_ms, 1000 * quantile_of(pictures, &LookedAt::waited_s, 0.95), figure,
                       all_ms);
  if (all_ms < 1000 * latency_limit_s) return {CheckVerdict::ok, "latency", figure};
  return {CheckVerdict::warning, "latency",
          fmt::format(
              "{}, expected {:.0f} at most, above it participants notice: use a shorter exposure, "
              "a faster camera mode, or another USB port",
              figure, 1000 * latency_limit_s)};
}

CheckResult speed_verdict(const Pictures& pictures, const Intrinsics& camera,
                          double wanted_rate_hz) {
  const double median_s = median(pictures, spent_s), p95_s = quantile_of(pictures, spent_s, 0.95),
               expected_s = expected_time_s(camera);
  const std::string figure = fmt::format("{:.1f} ms a picture, tracked and drawn (95 %: {:.1f} ms)",
                                         1000 * median_s, 1000 * p95_s);
  if (p95_s > 1 / wanted_rate_hz)
    return {
        CheckVerdict::failed, "speed",
        fmt::format("{}, but the protocol displays one each {:.0f} ms: end other programs, or use "
                    "a smaller camera mode",
                    figure, 1000 / wanted_rate_hz)};
  if (median_s <= expected_s) return {CheckVerdict::ok, "speed", figure};
  return {CheckVerdict::warning, "speed",
          fmt::format("{}, expected {:.0f} at {} x {}: this machine is slow or busy", figure,
                      1000 * expected_s, camera.width_px, camera.height_px)};
}

}  // namespace heft
