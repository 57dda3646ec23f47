// How cameras store light in 8 bits. Blur mixes light, not stored values, so edges are modeled on
// light and compared with what is stored. Most cameras store sRGB (IEC 61966-2-1), or nearly; the
// others' curves have other slopes in the dark and shoulders below white. With h(v) the light of a
// stored value v, 0...1,
//
//   h'(v) = h'_sRGB(v) exp(sum of bend_k * p_k(v)),   p = ln(v + .03), -ln(1.1 - v), 2 v - 1
//
// so a curve rises everywhere, whatever its bend, and another power, a shoulder and contrast in the
// middle need a number or two. Scale and offset of light are without meaning.
#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/Image.h"
#include "tracking/MarkerBody.h"

namespace heft {

/// A stored value, 0...255, and its derivative by the light.
struct Stored {
  double value, by_light;
};

/// Stored values at even steps of light; between them the tangent is off by less than 1/50 level.
struct StoredTable {
  static constexpr int steps = 4096;
  static constexpr double white = 255;
  std::array<Stored, steps + 1> at;

  Stored operator()(double light) const {
    if (light >= 1) return {white, 0};
    const double slope_in_dark = at.front().by_light;
    if (!(light > 0))
      return {slope_in_dark * light, slope_in_dark};  // what is no number stays none
    const double place = light * steps;
    const int nearest = static_cast<int>(place + 0.5);
    const Stored& there = at[static_cast<std::size_t>(nearest)];
    return {there.value + there.by_light * (place - nearest) / steps, there.by_light};
  }
};

/// sRGB. @param light 1 is where the sensor saturates; above, the derivative is 0
Stored stored_of_light(double light);

/// Light, 0...1, of a stored value, 0...255: sRGB.
double light_of_stored(double value);

using ToneBend = Eigen::Vector3d;

/// A camera's own curve; copies share their tables.
class ToneCurve {
 public:
  /// @param bend zero: sRGB
  explicit ToneCurve(const ToneBend& bend = ToneBend::Zero());

  const ToneBend& bend() const { return bend_; }
  Stored stored(double light) const { return (*stored_)(light); }
  double light(double value) const;
  /// How the value that is stored for a light moves with the bend.
  ToneBend stored_by_bend(double value) const;

 private:
  struct Tables;
  ToneBend bend_;
  std::shared_ptr<const Tables> tables_;
  const StoredTable* stored_;  ///< theirs
};

// A camera's response: the tone curve that the tracker learns from the board's edges, taken from
// the calibration's pictures, kept in the camera's file, and told in gray levels.

/// @param pictures of the board, in which the camera is calibrated already
/// @return none where the board's edges told nothing, as where its white is clipped
std::optional<std::array<double, 3>> learned_response(const Intrinsics& camera,
                                                      const MarkerBody& board,
                                                      const std::vector<Image>& pictures);

/// sRGB where the file says nothing.
ToneCurve response_of(const Intrinsics& camera);

/// How much brighter than by another curve middle grays are stored between a print's black and its
/// white, which both curves store alike: gray levels of 255, the most of any; negative where they
/// are darker.
double brighter_levels(const ToneCurve& curve, const ToneCurve& than);

/// From so many levels on a camera is said to bend tones.
inline constexpr double bending_levels = 10;

/// "12 of 255 levels darker than sRGB's"
std::string beside_srgb(double brighter_levels);

/// A line for the top of a camera's file.
std::string response_in_words(const Intrinsics& camera);

}  // namespace heft
