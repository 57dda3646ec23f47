// Light that is not the same all over the picture: a shadow's edge over the effector, wherever it
// goes, and a lamp's reflection on it.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "tracking/synthetic/SyntheticCamera.h"

namespace heft {

// From light to gray levels: the tone curve of a synthetic camera, looked up in a table.

struct Optics;

/// Gray levels (0...255) as the sensor has them before noise, in 1/64, so that no rounding but the
/// last one counts. Rows from the top, three channels.
using Levels = std::vector<std::int16_t>;
inline constexpr int level_steps = 64;
/// Noise comes before the clipping of white, so levels go on above it until no noise brings them
/// back.
inline constexpr double most_light = 1.4, most_level = 300;

class LevelCurve {
 public:
  /// Of the optics the tone curve alone counts.
  explicit LevelCurve(const Optics& optics);

  /// @param light 0 to most_light
  static int place_of(float light) {
    constexpr float per_most = static_cast<float>(1 / most_light);
    return static_cast<int>(std::sqrt(per_most * light) * intervals + 0.5F);
  }
  std::int16_t at(int place) const { return levels_[static_cast<std::size_t>(place)]; }

 private:
  // Seen over the root of light, the curve is steep nowhere: the nearest of so many values is
  // within 1/300 level, of a gamma of 2.2 within 1/75 in the dark.
  static constexpr int intervals = 65535;
  std::vector<std::int16_t> levels_;  ///< at equally spaced roots of light
};

/// sRGB's light of each level, the other way round.
std::vector<float> light_of_levels();

class UnevenLight {
 public:
  UnevenLight(const Optics& optics, int width_px);

  /// A picture in that light, by the camera's tone curve.
  /// @param even the same picture without, by sRGB  @param at_px where the effector is seen; none:
  /// shadow and reflection are out of the picture, too
  Levels on(const Levels& even, const std::optional<Eigen::Vector2d>& at_px) const;

 private:
  float lit(float right_px, float down_px) const;
  float reflected(float right_px, float down_px) const;

  float shadow_, glare_, glare_px_;
  int width_;
  LevelCurve curve_;
  std::vector<float> light_;  ///< of levels
};

}  // namespace heft
