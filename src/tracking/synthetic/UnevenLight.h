// Uneven light: a shadow's edge across the effector, which follows it, and a lamp's reflection on
// it; lamps that flicker; and a camera that adjusts its gain and white balance.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "tracking/synthetic/SyntheticCamera.h"

namespace heft {

// The tone curve of a synthetic camera, from light to gray levels, as a table.

/// Gray levels (0...255) before noise, in 1/64, so that only the final rounding matters. Rows from
/// the top, three channels.
using Levels = std::vector<std::int16_t>;
inline constexpr int level_steps = 64;
/// Noise is added before white is clipped, so levels extend above it as far as noise reaches.
inline constexpr double most_light = 1.4, most_level = 300;

class LevelCurve {
 public:
  /// Uses the tone curve of the optics only.
  explicit LevelCurve(const Optics& optics);

  /// @param light 0 to most_light
  static int place_of(float light) {
    constexpr float per_most = static_cast<float>(1 / most_light);
    return static_cast<int>(std::sqrt(per_most * light) * intervals + 0.5F);
  }
  std::int16_t at(int place) const { return levels_[static_cast<std::size_t>(place)]; }

 private:
  // As a function of the root of light, the curve has no steep part: the nearest of so many values
  // is accurate to 1/300 level, for a gamma of 2.2 in the dark to 1/75.
  static constexpr int intervals = 65535;
  std::vector<std::int16_t> levels_;  ///< at equally spaced roots of light
};

/// The inverse of sRGB: light of each level.
std::vector<float> light_of_levels();

class UnevenLight {
 public:
  UnevenLight(const Optics& optics, int width_px, int height_px);

  /// Whether these optics have any.
  static bool is_in(const Optics& optics);

  /// A picture in uneven light, by the camera's tone curve.
  /// @param even the same picture in even light, by sRGB  @param at_px position of the effector;
  /// none: shadow and
  ///   reflection are out of the picture, too
  /// @param t_s when the first row is exposed
  Levels on(const Levels& even, const std::optional<Eigen::Vector2d>& at_px, double t_s) const;

 private:
  float lit(float right_px, float down_px) const;
  float reflected(float right_px, float down_px) const;
  std::array<float, 3> gains(double t_s, double row_s) const;

  Optics optics_;
  float shadow_, glare_, glare_px_;
  int width_, height_;
  LevelCurve curve_;
  std::vector<float> light_;  ///< by level
};

}  // namespace heft
