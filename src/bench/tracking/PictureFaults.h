// What other cameras, and the light before them, do to a picture of the synthetic camera: tone
// curves with a shoulder, a shadow's edge, glare, a color mosaic, sharpening, JPEG. The picture
// comes without noise, as sRGB in 8 bits; its rounding is lost in the noise that is added here.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <vector>

#include "base/Image.h"

namespace heft {

/// In the order in which they come about.
struct PictureFaults {
  double shadow = 1;  ///< of the light that is left on one side of a line through the effector
  /// Light that a lamp's reflection adds at the effector, 1 being white; half of it at 40 pixels of
  /// 640.
  double glare = 0;
  std::function<double(double light)> tone;  ///< 0...1 of light 0...1; none: sRGB
  double noise = 3;                          ///< sd, of 255
  bool mosaic = false;    ///< each pixel has one color, the others are interpolated
  double sharpening = 0;  ///< of the stored values: what a blur of 1 px takes off, times it
  int jpeg_quality = 0;   ///< of libjpeg's scale; 0: not compressed. Luminance alone.
};

/// A shoulder and a toe: Narkowicz's fit of the film curve of the Academy Color Encoding System,
/// stored as sRGB. @param share of it, the rest is sRGB
double film_tone(double light, double share);
/// sRGB, then more contrast in the middle.
double s_curve_tone(double light, double strength);

/// @param clean of the synthetic camera, without noise  @param at_px where the effector is seen
/// @return in one channel
Image with_faults(const Image& clean, const PictureFaults& faults, const Eigen::Vector2d& at_px,
                  std::uint64_t number);

}  // namespace heft
