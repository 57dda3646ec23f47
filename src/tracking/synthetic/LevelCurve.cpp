#include "tracking/synthetic/LevelCurve.h"

#include <algorithm>

#include "tracking/SyntheticCamera.h"
#include "tracking/ToneCurve.h"

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

}  // namespace heft
