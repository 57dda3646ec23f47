// From light to bytes: the lens' blur, vignetting, exposure, the tone curve, noise, rounding.
#pragma once

#include <cstdint>
#include <vector>

#include "base/Image.h"
#include "tracking/SyntheticCamera.h"
#include "tracking/synthetic/AreaRaster.h"

namespace heft {

/// Gray levels (0...255) as the sensor has them before noise, in 1/64, so that no rounding but the
/// last one counts. Rows from the top, three channels.
using Levels = std::vector<std::int16_t>;
inline constexpr int level_steps = 64;

class Sensor {
 public:
  Sensor(const Optics& optics, int width_px, int height_px, std::uint64_t seed);

  /// How far the blur reaches.
  int blur_reach_px() const { return static_cast<int>(kernel_.size()) - 1; }

  /// Blurs the part of a picture within `box` (and its own); light from beyond its edges is like
  /// that at its edges. @return a picture of that box
  void blur(const LightPicture& sharp, const PixelBox& box, LightPicture& blurred);

  /// Writes the levels of a blurred picture into those of the whole picture.
  void expose(const LightPicture& blurred, Levels& levels) const;

  /// Adds the noise of that picture and rounds.
  Image develop(const Levels& levels, std::uint64_t number) const;

 private:
  float gain_at(int x, int y) const;
  std::int16_t level_of(float light) const;

  Optics optics_;
  int width_, height_;
  std::uint64_t seed_;
  double lost_per_px2_;              ///< light, with the square of the distance from the middle
  std::vector<float> kernel_;        ///< half of a symmetric one: from its middle outwards
  std::vector<float> curve_;         ///< levels at equally spaced light
  std::vector<std::int16_t> noise_;  ///< a long row of independent draws, in 1/64 level
  LightPicture blurred_along_rows_;
};

}  // namespace heft
