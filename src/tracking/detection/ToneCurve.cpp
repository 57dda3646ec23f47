#include "tracking/detection/ToneCurve.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace heft {

namespace {
constexpr double white = StoredTable::white;
constexpr int steps = StoredTable::steps;
constexpr double dark_slope = 12.92;
constexpr double dark_light = 0.0031308;

Stored exactly(double light) {
  if (light <= dark_light) return {white * dark_slope * light, white * dark_slope};
  const double power = std::pow(light, 1 / 2.4), slope = white * 1.055 / 2.4 * power / light;
  return {white * (1.055 * power - 0.055), slope};
}

const StoredTable srgb_table = [] {
  StoredTable made{};
  for (int i = 0; i <= steps; ++i)
    made.at[static_cast<std::size_t>(i)] = exactly(static_cast<double>(i) / steps);
  return made;
}();

// d light / d value of sRGB, both 0...1.
double srgb_slope(double v) {
  return v <= dark_slope * dark_light ? 1 / dark_slope
                                      : 2.4 / 1.055 * std::pow((v + 0.055) / 1.055, 1.4);
}

ToneBend bends_at(double v) {
  return {std::log(v + 0.03), -std::log(1.1 - v), 2 * v - 1};
}
}  // namespace

Stored stored_of_light(double light) {
  return srgb_table(light);
}

double light_of_stored(double value) {
  const double v = std::clamp(value / white, 0.0, 1.0);
  return v <= dark_slope * dark_light ? v / dark_slope : std::pow((v + 0.055) / 1.055, 2.4);
}

// At even steps of the stored value, and of light.
struct ToneCurve::Tables {
  static constexpr int n = 510;
  std::array<double, n + 1> light{}, light_by_value{};
  std::array<ToneBend, n + 1> light_by_bend;
  StoredTable stored;

  explicit Tables(const ToneBend& bend) {
    ToneBend before = ToneBend::Zero();
    light_by_bend[0].setZero();
    for (std::size_t i = 0; i <= n; ++i) {
      const double v = static_cast<double>(i) / n;
      const ToneBend bends = bends_at(v);
      light_by_value[i] = srgb_slope(v) * std::exp(bend.dot(bends));
      const ToneBend now = light_by_value[i] * bends;
      if (i > 0) {
        light[i] = light[i - 1] + (light_by_value[i - 1] + light_by_value[i]) / (2 * n);
        light_by_bend[i] = light_by_bend[i - 1] + (before + now) / (2 * n);
      }
      before = now;
    }
    const double most = light[n];
    const ToneBend most_by_bend = light_by_bend[n];
    for (std::size_t i = 0; i <= n; ++i) {
      light[i] /= most;
      light_by_value[i] /= most;
      light_by_bend[i] = (light_by_bend[i] - light[i] * most_by_bend) / most;
    }
    invert();
    if (bend.isZero()) be_srgb();
  }

  // Exact for every whole stored value.
  void be_srgb() {
    stored = srgb_table;
    for (std::size_t i = 0; i <= n; ++i)
      light[i] = light_of_stored(white * static_cast<double>(i) / n);
  }

  void invert() {
    std::size_t below = 0;
    for (std::size_t i = 0; i <= steps; ++i) {
      const double wanted = static_cast<double>(i) / steps;
      while (below + 1 < n && light[below + 1] < wanted) ++below;
      const double fraction = (wanted - light[below]) / (light[below + 1] - light[below]);
      const double slope =
          light_by_value[below] + fraction * (light_by_value[below + 1] - light_by_value[below]);
      stored.at[i] = {white * (static_cast<double>(below) + fraction) / n, white / slope};
    }
  }
};

ToneCurve::ToneCurve(const ToneBend& bend) : bend_(bend) {
  static const auto srgb = std::make_shared<const Tables>(ToneBend::Zero());
  tables_ = bend.isZero() ? srgb : std::make_shared<const Tables>(bend);
  stored_ = &tables_->stored;
}

double ToneCurve::light(double value) const {
  const double place = std::clamp(value / white, 0.0, 1.0) * Tables::n;
  const auto below = std::min(static_cast<std::size_t>(place), std::size_t{Tables::n - 1});
  const double fraction = place - static_cast<double>(below);
  return tables_->light[below] + fraction * (tables_->light[below + 1] - tables_->light[below]);
}

ToneBend ToneCurve::stored_by_bend(double value) const {
  const double place = std::clamp(value / white, 0.0, 1.0) * Tables::n;
  const auto nearest = static_cast<std::size_t>(place + 0.5);
  return -white / tables_->light_by_value[nearest] * tables_->light_by_bend[nearest];
}

}  // namespace heft
