#include "tracking/synthetic/UnevenLight.h"

#include <algorithm>

#include "tracking/detection/ToneCurve.h"
#include "tracking/synthetic/SyntheticCamera.h"

namespace heft {

namespace {
constexpr double white = 255, srgb_slope_at_white = white * 1.055 / 2.4;

double stored(double light, const std::optional<double>& gamma) {
  return gamma ? white * std::pow(light, 1 / *gamma) : stored_of_light(light).value;
}

// A toe and a shoulder: Narkowicz's fit of the film curve of the Academy Color Encoding System.
double film(double light) {
  const double x = 0.8 * light;
  return x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14);
}

double level_of(double light, const Optics& optics) {
  const double below = std::min(light, 1.0);
  const double v = (1 - optics.film_curve) * stored(below, optics.gamma) +
                   optics.film_curve * stored(film(below), optics.gamma);
  const double bent =
      (1 - optics.s_curve) * v + optics.s_curve * v * v / white * (3 - 2 * v / white);
  const double slope_at_white = (1 - optics.film_curve) * (1 - optics.s_curve) *
                                (optics.gamma ? white / *optics.gamma : srgb_slope_at_white);
  return bent + slope_at_white * (light - below);
}
}  // namespace

LevelCurve::LevelCurve(const Optics& optics) {
  for (int i = 0; i <= intervals; ++i) {
    const double light = most_light * std::pow(static_cast<double>(i) / intervals, 2);
    const double level = std::min(level_of(light, optics), most_level);
    levels_.push_back(static_cast<std::int16_t>(std::lround(level_steps * level)));
  }
}

std::vector<float> light_of_levels() {
  std::vector<float> light;
  for (int i = 0; i <= level_steps * most_level; ++i) {
    const double level = static_cast<double>(i) / level_steps;
    const double above_white = std::max(0.0, level - white) / srgb_slope_at_white;
    light.push_back(static_cast<float>(light_of_stored(level) + above_white));
  }
  return light;
}

namespace {
constexpr float penumbra_px = 2;
constexpr double gain_period_s = 4, balance_period_s = 5, flicker_hz = 100;
constexpr float across_x = 0.8F, across_y = 0.6F;  // the shadow's edge is slanted to the tags
}  // namespace

bool UnevenLight::is_in(const Optics& optics) {
  return optics.shadow > 0 || optics.glare > 0 || optics.auto_gain > 0 ||
         optics.auto_white_balance > 0 || optics.flicker > 0;
}

UnevenLight::UnevenLight(const Optics& optics, int width_px, int height_px)
    : optics_(optics),
      shadow_(static_cast<float>(optics.shadow)),
      glare_(static_cast<float>(optics.glare)),
      glare_px_(static_cast<float>(width_px) / 16),
      width_(width_px),
      height_(height_px),
      curve_(optics),
      light_(light_of_levels()) {}

float UnevenLight::lit(float right_px, float down_px) const {
  const float across_px = across_x * right_px + across_y * down_px;
  return 1 - shadow_ * std::clamp(0.5F - across_px / penumbra_px, 0.0F, 1.0F);
}

float UnevenLight::reflected(float right_px, float down_px) const {
  const float squared = (right_px * right_px + down_px * down_px) / (glare_px_ * glare_px_);
  return squared < 30 ? glare_ * std::exp2(-squared) : 0;
}

// Gains of blue, green and red at a row that is exposed row_s after the first one. The mean over an
// exposure flickers less.
std::array<float, 3> UnevenLight::gains(double t_s, double row_s) const {
  const auto wave = [&](double period_s) { return std::sin(2 * M_PI * t_s / period_s); };
  const double half_turn = M_PI * flicker_hz * optics_.exposure_s;
  const double seen = half_turn > 0 ? std::sin(half_turn) / half_turn : 1;
  const double lamp = 1 + optics_.flicker * seen * std::sin(2 * M_PI * flicker_hz * (t_s + row_s));
  const double gain = lamp * (1 + optics_.auto_gain * wave(gain_period_s));
  const double red = optics_.auto_white_balance * wave(balance_period_s);
  return {static_cast<float>(gain * (1 - red)), static_cast<float>(gain),
          static_cast<float>(gain * (1 + red))};
}

Levels UnevenLight::on(const Levels& even, const std::optional<Eigen::Vector2d>& at_px,
                       double t_s) const {
  Levels uneven;
  uneven.reserve(even.size());
  const int n_pixels = static_cast<int>(even.size() / 3);
  std::array<float, 3> now{};
  for (int i = 0; i < n_pixels; ++i) {
    if (i % width_ == 0) now = gains(t_s, optics_.readout_s * (i / width_) / height_);
    float gain = 1, more = 0;
    if (at_px) {
      const int column = i % width_, row = i / width_;
      const auto right_px = static_cast<float>(column - at_px->x());
      const auto down_px = static_cast<float>(row - at_px->y());
      gain = lit(right_px, down_px);
      more = reflected(right_px, down_px);
    }
    for (std::size_t channel = 0; channel < 3; ++channel) {
      const auto level = even[3 * static_cast<std::size_t>(i) + channel];
      const float lit = gain * light_[static_cast<std::size_t>(level)] + more;
      const float light = now[channel] * lit;
      constexpr auto most = static_cast<float>(most_light);
      uneven.push_back(curve_.at(LevelCurve::place_of(std::min(light, most))));
    }
  }
  return uneven;
}

}  // namespace heft
