// The verdict on a camera calibration.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tracking/calibration/CameraCalibration.h"

namespace heft {

namespace {
constexpr double degrees = 180 / M_PI;

// Sufficient for rays within 0.2 px: measured on synthetic views.
constexpr std::size_t enough_views = 15;
constexpr double enough_coverage = 0.7;
constexpr double enough_tilt_rad = 40 / degrees;
constexpr double enough_distance_ratio = 1.15;
constexpr double good_rms_px = 0.15;
constexpr double good_relative_focal_sd = 0.001;
}  // namespace

void Coverage::add(const TagView& view, int width_px, int height_px) {
  for (const SeenTag& seen : view.tags)
    for (const Eigen::Vector2d& corner : seen.corners_px) {
      const auto column = static_cast<int>((corner.x() + 0.5) * columns / width_px);
      const auto row = static_cast<int>((corner.y() + 0.5) * rows / height_px);
      ++corners.at(static_cast<std::size_t>(std::clamp(row, 0, rows - 1)))
            .at(static_cast<std::size_t>(std::clamp(column, 0, columns - 1)));
    }
}

double Coverage::fraction() const {
  int n = 0;
  for (const auto& row : corners)
    n += static_cast<int>(std::ranges::count_if(row, [](int seen) { return seen > 0; }));
  return static_cast<double>(n) / (columns * rows);
}

std::string Coverage::drawing() const {
  constexpr int much = 12;
  std::string text;
  for (const auto& row : corners) {
    for (const int n : row) text += n == 0 ? " ." : n < much ? " o" : " #";
    text += '\n';
  }
  return text;
}

std::string Coverage::emptiest() const {
  constexpr std::array<const char*, 3> across{"left", "middle", "right"};
  constexpr std::array<const char*, 3> down{"upper", "middle", "lower"};
  std::array<int, 9> empty{};
  for (std::size_t row = 0; row < rows; ++row)
    for (std::size_t column = 0; column < columns; ++column)
      if (corners[row][column] == 0) ++empty[row * 3 / rows * 3 + column * 3 / columns];
  const auto worst = std::ranges::max_element(empty);
  if (*worst == 0) return "";
  const auto place = static_cast<std::size_t>(worst - empty.begin());
  if (place == 4) return "the middle";
  return fmt::format("the {} {}", down[place / 3], across[place % 3]);
}

std::size_t CameraCalibration::n_used() const {
  return static_cast<std::size_t>(std::ranges::count(views, true, &CalibratedView::used));
}

double CameraCalibration::tilt_range_rad() const {
  double widest = 0;
  for (const CalibratedView& a : views)
    for (const CalibratedView& b : views)
      if (a.used && b.used)
        widest = std::max(widest, std::acos(std::clamp(a.normal.dot(b.normal), -1.0, 1.0)));
  return widest;
}

double CameraCalibration::distance_ratio() const {
  double nearest_m = 0, farthest_m = 0;
  for (const CalibratedView& view : views) {
    if (!view.used) continue;
    nearest_m = nearest_m > 0 ? std::min(nearest_m, view.distance_m) : view.distance_m;
    farthest_m = std::max(farthest_m, view.distance_m);
  }
  return nearest_m > 0 ? farthest_m / nearest_m : 1;
}

namespace {
void doubt_print(const PrintShape& print, std::vector<std::string>& list) {
  if (print.is_stretched())
    list.push_back(fmt::format(
        "the board's print is {:.2f} % ({:.2f} either way) longer {} than in its file: measure "
        "both rulers of its sheet and write ruler_measured_m = [across, down] into the file",
        100 * std::abs(print.stretch), 200 * print.stretch_sd,
        print.stretch > 0 ? "across than down" : "down than across"));
  if (print.is_sheared())
    list.push_back(fmt::format(
        "the board's print is sheared: its right angles are off by {:.2f} degrees ({:.2f} either "
        "way), as if the paper was fed askew; print it again, or with another printer",
        std::abs(print.shear_rad) * degrees, 2 * print.shear_sd_rad * degrees));
}

void doubt_tags(const TagPrint& tags, std::vector<std::string>& list) {
  if (!tags.is_off()) return;
  list.push_back(fmt::format(
      "the board's tags are printed {:.2f} % ({:.2f} either way) {} than its file says, relative "
      "to their distances: multiply tag_m of its [grid] by {:.4f}, or enlarge the corners of each "
      "[[tag]] about its center; the camera was calibrated with this size",
      100 * std::abs(tags.excess), 200 * tags.excess_sd, tags.excess > 0 ? "larger" : "smaller",
      1 + tags.excess));
}

std::string ink_in_words(const TagPrint& tags) {
  if (!tags.has_spread()) return "";
  return fmt::format(
      "ink: spreads by {:.2f} mm ({:.2f} either way) beyond the edges of black squares; this is "
      "the print, not the camera, and tracking corrects it as it does a tone curve\n",
      1e3 * tags.ink_m, 2e3 * tags.ink_sd_m);
}
}  // namespace

std::vector<std::string> doubts(const CameraCalibration& calibration) {
  std::vector<std::string> list;
  const auto doubt = [&](bool when, const std::string& text) {
    if (when) list.push_back(text);
  };
  doubt_print(calibration.print, list);
  doubt_tags(calibration.tags, list);
  const double relative_focal_sd = calibration.focal_sd_px / calibration.camera.fx_px;
  doubt(calibration.n_used() < enough_views,
        fmt::format("{} views are few; take {} or more", calibration.n_used(), enough_views));
  doubt(calibration.coverage.fraction() < enough_coverage,
        fmt::format("the board was in {:.0f} % of the picture; take views with it in {}",
                    100 * calibration.coverage.fraction(), calibration.coverage.emptiest()));
  doubt(calibration.tilt_range_rad() < enough_tilt_rad,
        fmt::format("views differ by {:.0f} degrees at most; tilt the board (or the camera) to all "
                    "sides, by about 30 degrees",
                    calibration.tilt_range_rad() * degrees));
  doubt(calibration.distance_ratio() < enough_distance_ratio,
        "all views are from one distance; bring the board nearer and farther away");
  doubt(calibration.rms_px > good_rms_px,
        fmt::format(
            "corners are {:.2f} px off (rms), expected {} or less; check that the board is flat, "
            "the picture sharp, the exposure short, and the focus locked",
            calibration.rms_px, good_rms_px));
  doubt(relative_focal_sd > good_relative_focal_sd,
        fmt::format(
            "the focal length has a standard error of {:.2f} %, expected {} %; take more views, "
            "more tilted and nearer",
            100 * relative_focal_sd, 100 * good_relative_focal_sd));
  return list;
}

std::string verdict_of(const std::vector<std::string>& doubts) {
  std::string text = doubts.empty() ? "verdict: good\n" : "verdict: doubtful\n";
  for (const std::string& line : doubts) text += fmt::format("  {}\n", line);
  return text;
}

std::string summary(const CameraCalibration& calibration) {
  std::string text = fmt::format(
      "{} views used of {}, reprojection {:.3f} px rms, standard errors: focal length {:.2f} px, "
      "center {:.2f} px\nboard seen in {:.0f} % of the picture, tilts differ by {:.0f} degrees\n",
      calibration.n_used(), calibration.views.size(), calibration.rms_px, calibration.focal_sd_px,
      calibration.center_sd_px, 100 * calibration.coverage.fraction(),
      calibration.tilt_range_rad() * degrees);
  text +=
      fmt::format("size of the tags relative to their distances: {:+.2f} % ({:.2f} either way)\n",
                  100 * calibration.tags.excess, 200 * calibration.tags.excess_sd);
  text += ink_in_words(calibration.tags);
  text += verdict_of(doubts(calibration));
  // A scaled scene at a scaled distance gives the same picture.
  return text +
         "pictures cannot show whether the board's print is too large or too small as a whole: "
         "measure its ruler (ruler_measured_m); the effector's is compared with it by heft "
         "calibrate effector --on-board\n";
}

}  // namespace heft
