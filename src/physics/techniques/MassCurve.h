// A parameter of a technique as a function of mass.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace heft {

/// A table, interpolated linearly over the logarithm of mass and constant beyond its ends.
class MassCurve {
 public:
  struct Point {
    double mass_kg = 1, value = 1;
  };

  MassCurve() = default;  ///< 1 everywhere
  /// @param points at least one, masses above zero and ascending
  explicit MassCurve(std::vector<Point> points) : points_(std::move(points)) {}

  const std::vector<Point>& points() const { return points_; }

  double at(double mass_kg) const;

 private:
  std::vector<Point> points_ = std::vector<Point>(1);
};

/// "gain 0.95 at 15 g, 0.2 at 800 g, back in 0.05 s"
/// @param unit of the curve's values, with a leading space
std::string displacement_text(std::string_view name, const MassCurve& curve, std::string_view unit,
                              double return_s);

}  // namespace heft
