// Verdicts on what changes from picture to picture: ghosts of the last one, flicker, gain, focus,
// and lost pictures.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apparatus/checks/ApparatusCheck.h"
#include "base/math/Quantiles.h"
#include "tracking/detection/ToneCurve.h"

namespace heft {

namespace {
constexpr double most_of_last_picture = 0.1, most_flicker = 0.02, most_gain = 0.05;
constexpr double most_breathing = 0.001, most_lost = 0.02;

CheckResult verdict(bool is_ok, const char* name, const std::string& figure, const char* advice) {
  if (is_ok) return {CheckVerdict::ok, name, figure};
  return {CheckVerdict::warning, name, fmt::format("{}; {}", figure, advice)};
}

double median_of(std::vector<double> values) {
  return quantile(std::move(values), 0.5).value_or(0);
}

// Light of the pictures relative to the first one, as logarithms.
std::vector<double> light_over_time(const Pictures& pictures) {
  std::vector<double> light;
  double sum = 0;
  for (const LookedAt& seen : pictures) light.push_back(sum += seen.brighter);
  return light;
}

// A rolling shutter shows a lamp's flicker as bands, another one as pictures that alternate.
double flicker_of(const Pictures& pictures) {
  std::vector<double> bands, alternating{0};
  const std::vector<double> light = light_over_time(pictures);
  for (std::size_t i = 1; i < light.size(); ++i) {
    bands.push_back(pictures[i].banded);
    if (i > 1) alternating.push_back(std::abs(light[i] - 2 * light[i - 1] + light[i - 2]) / 2);
  }
  return std::max(median_of(bands), median_of(alternating));
}
}  // namespace

std::vector<double> light_of_blocks(const Image& image) {
  constexpr int side_px = light_block_px;
  std::vector<double> light;
  for (int top = 0; top + side_px <= image.height; top += side_px)
    for (int left = 0; left + side_px <= image.width; left += side_px) {
      double sum = 0;
      for (int y = top; y < top + side_px; ++y)
        for (int x = left; x < left + side_px; ++x)
          sum += image.pixels[static_cast<std::size_t>(y) * image.row_bytes() +
                              static_cast<std::size_t>(x * image.channels)];
      light.push_back(light_of_stored(sum / (side_px * side_px)));
    }
  return light;
}

// Medians over each row of blocks, since something may move.
void compare_light(const std::vector<double>& before, const std::vector<double>& now, int n_across,
                   LookedAt& seen) {
  constexpr double least_light = 0.01;
  if (before.size() != now.size() || n_across < 1) return;
  std::vector<double> rows;
  for (std::size_t start = 0; start < now.size(); start += static_cast<std::size_t>(n_across)) {
    std::vector<double> row;
    for (std::size_t i = start; i < start + static_cast<std::size_t>(n_across); ++i)
      if (before[i] > least_light && now[i] > least_light)
        row.push_back(std::log(now[i] / before[i]));
    if (!row.empty()) rows.push_back(median_of(std::move(row)));
  }
  if (rows.empty()) return;
  seen.brighter = median_of(rows);
  double squares = 0;
  for (const double row : rows) squares += (row - seen.brighter) * (row - seen.brighter);
  seen.banded = std::sqrt(squares / static_cast<double>(rows.size()));
}

CheckResult ghosting_verdict(const Pictures& pictures) {
  const double share = pictures.back().tracked.last_picture;
  return verdict(share <= most_of_last_picture, "ghosting",
                 fmt::format("{:.0f} % of the last picture is left in each (expected {:.0f} % at "
                             "most)",
                             100 * share, 100 * most_of_last_picture),
                 "the tracker removes it, but not after lost pictures: turn off the camera's "
                 "temporal noise reduction, or use more light and a lower gain");
}

CheckResult flicker_verdict(const Pictures& pictures) {
  const double flicker = flicker_of(pictures);
  return verdict(flicker <= most_flicker, "flicker",
                 fmt::format("light flickers by {:.1f} % (expected {:.0f} % at most)",
                             100 * flicker, 100 * most_flicker),
                 "set the camera's power line frequency (50 or 60 Hz), use an exposure of 10 or "
                 "8.3 ms, or lamps that do not flicker");
}

CheckResult gain_verdict(const Pictures& pictures) {
  const std::vector<double> light = light_over_time(pictures);
  const double change =
      std::exp(quantile(light, 0.95).value_or(0) - quantile(light, 0.05).value_or(0)) - 1;
  return verdict(change - flicker_of(pictures) <= most_gain, "gain",
                 fmt::format("brightness changes by {:.0f} % (expected {:.0f} % at most)",
                             100 * change, 100 * most_gain),
                 "lock exposure and gain, and keep daylight and shadows off the table");
}

CheckResult breathing_verdict(const Pictures& pictures) {
  double largest = 0;
  for (const LookedAt& seen : pictures)
    largest = std::max(largest, std::abs(seen.tracked.focal_length_scale - 1));
  return verdict(largest <= most_breathing, "focal length",
                 fmt::format("within {:.2f} % of the calibrated one (expected {:.1f} % at most)",
                             100 * largest, 100 * most_breathing),
                 "lock the focus, and calibrate the camera again");
}

CheckResult lost_verdict(const Pictures& pictures) {
  std::vector<double> intervals_s;
  const auto numbers = [&](std::size_t i) {
    return std::max<double>(1, static_cast<double>(pictures[i].number - pictures[i - 1].number));
  };
  const auto gap_s = [&](std::size_t i) {
    return pictures[i].capture_s - pictures[i - 1].capture_s;
  };
  for (std::size_t i = 1; i < pictures.size(); ++i) intervals_s.push_back(gap_s(i) / numbers(i));
  const double usual_s = median_of(intervals_s);
  double lost = 0, all = 1;
  for (std::size_t i = 1; i < pictures.size() && usual_s > 0; ++i) {
    const double passed = std::max(numbers(i), std::round(gap_s(i) / usual_s));
    lost += passed - numbers(i) + (pictures[i].tracked.repeated ? 1 : 0);
    all += passed;
  }
  return verdict(lost <= most_lost * all, "lost pictures",
                 fmt::format("{:.0f} of {:.0f} were lost or repeat the one before (expected {:.0f} "
                             "% at most)",
                             lost, all, 100 * most_lost),
                 "use another USB port without a hub, turn off the camera's dynamic frame rate, "
                 "and end other programs");
}

}  // namespace heft
