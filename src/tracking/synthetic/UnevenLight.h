// Light that is not the same all over the picture: a shadow's edge over the effector, wherever it
// goes, and a lamp's reflection on it.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "tracking/SyntheticCamera.h"
#include "tracking/synthetic/LevelCurve.h"

namespace heft {

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
