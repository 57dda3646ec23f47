// Tone curves: how cameras store light in 8 bits. Blur mixes light, not stored values, so edges are
// modeled in light and compared with stored values. Most cameras store sRGB (IEC 61966-2-1), or
// nearly; others have other slopes in the dark and shoulders below white. With h(v) the light of a
// stored value v, 0...1,
//
//   h'(v) = h'_sRGB(v) exp(sum of bend_k * p_k(v)),   p = ln(v + .03), -ln(1.1 - v), 2 v - 1
//
// so that a curve always rises, and another power, a shoulder or mid-tone contrast takes one or two
// numbers. Scale and offset of light are arbitrary.
#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>

namespace heft {

/// A stored value, 0...255, and its derivative by light.
struct Stored {
  double value, by_light;
};

/// Stored values at even steps of light; the tangent in between is accurate to 1/50 level.
struct StoredTable {
  static constexpr int steps = 4096;
  static constexpr double white = 255;
  std::array<Stored, steps + 1> at;

  Stored operator()(double light) const {
    if (light >= 1) return {white, 0};
    const double slope_in_dark = at.front().by_light;
    if (!(light > 0)) return {slope_in_dark * light, slope_in_dark};  // NaN stays NaN
    const double place = light * steps;
    const int nearest = static_cast<int>(place + 0.5);
    const Stored& there = at[static_cast<std::size_t>(nearest)];
    return {there.value + there.by_light * (place - nearest) / steps, there.by_light};
  }
};

/// sRGB. @param light 1 is saturation; above it the derivative is 0
Stored stored_of_light(double light);

/// Light, 0...1, of a stored value, 0...255: sRGB.
double light_of_stored(double value);

using ToneBend = Eigen::Vector3d;

/// A camera's curve; copies share their tables.
class ToneCurve {
 public:
  /// @param bend zero: sRGB
  explicit ToneCurve(const ToneBend& bend = ToneBend::Zero());

  const ToneBend& bend() const { return bend_; }
  Stored stored(double light) const { return (*stored_)(light); }
  double light(double value) const;
  /// Derivative of a light's stored value by the bend.
  ToneBend stored_by_bend(double value) const;

 private:
  struct Tables;
  ToneBend bend_;
  std::shared_ptr<const Tables> tables_;
  const StoredTable* stored_;  ///< in tables_
};

}  // namespace heft
