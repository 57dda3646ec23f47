// From light to bytes: the lens's blur, vignetting, exposure, uneven light, the tone curve, noise,
// rounding, and the camera's processing.
#pragma once

#include <cstdint>
#include <vector>

#include "base/Image.h"
#include "tracking/synthetic/AreaRaster.h"
#include "tracking/synthetic/SyntheticCamera.h"
#include "tracking/synthetic/UnevenLight.h"

namespace heft {

class Sensor {
 public:
  Sensor(const Optics& optics, int width_px, int height_px, std::uint64_t seed);

  /// Extent of the blur in fine pixels, and in the picture's.
  int fine_reach() const { return static_cast<int>(kernel_.size()); }
  int reach_px() const { return (fine_reach() + fineness - 1) / fineness; }

  /// Writes these parts of a picture, blurred, into the levels of the whole picture. They need the
  /// light around them within the blur's extent; beyond the picture's edges the light continues.
  /// @param sharp in fine pixels  @param spans of the picture's pixels
  void expose(const LightPicture& sharp, const RowSpans& spans, Levels& levels);

  /// Index of a pixel's first channel in the levels.
  std::ptrdiff_t place_of(int x, int y) const {
    return (static_cast<std::ptrdiff_t>(y) * width_ + x) * 3;
  }

  /// Adds the noise of that picture, rounds and processes it.
  /// @param effector_px its position, if it is visible  @param t_s when the first row is exposed
  Image develop(const Levels& levels, std::uint64_t number,
                const std::optional<Eigen::Vector2d>& effector_px = std::nullopt,
                double t_s = 0) const;

 private:
  float lost_light(int place, int n_places) const;
  void blur_along_rows(const LightPicture& sharp, const RowSpans& spans);
  void blur_across_rows(int y, const Span& span);
  void expose_row(int y, const Span& span, std::int16_t* levels);
  Image noisy(const Levels& levels, std::uint64_t number) const;

  Optics optics_;
  int width_, height_;
  std::uint64_t seed_;
  double lost_per_px2_;  ///< fraction of light, times the squared distance from the middle
  std::vector<float> lost_by_column_;
  /// Half of a symmetric kernel of fine pixels, from a pixel's middle outwards: its extent and the
  /// blur.
  std::vector<float> kernel_;
  LevelCurve curve_;  ///< sRGB if followed by uneven light
  std::optional<UnevenLight> uneven_light_;
  std::vector<std::int16_t> noise_;  ///< a long row of independent draws, three channels each
  LightPicture along_rows_;          ///< blurred along rows: fine rows of the picture's columns
  std::vector<Light> row_, padded_row_;
  std::vector<int> places_;  ///< of a row's light in the curve
};

/// @param picture with three channels
/// @throws Error if the codecs' module is missing
Image processed(Image picture, const Optics& optics);

}  // namespace heft
