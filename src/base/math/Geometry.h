// Overlap of oriented boxes; convex polygons of few corners and their clipping.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "base/PoseTypes.h"

namespace heft {

/// Separating-axis test of two boxes given by the poses of their centers and their full sizes.
/// Boxes that touch overlap.
bool boxes_overlap(const Pose& a, const Eigen::Vector3d& size_a_m, const Pose& b,
                   const Eigen::Vector3d& size_b_m);

/// Up to `most` corners in order, without heap memory. Further corners are dropped. A corner may be
/// a point, or a point with further values.
template <typename Corner, std::size_t most>
class Polygon {
 public:
  Polygon() = default;
  explicit Polygon(std::span<const Corner> corners) {
    for (const Corner& corner : corners) add(corner);
  }

  void add(const Corner& corner) {
    if (n_ < most) corners_[n_++] = corner;
  }
  void keep_first(std::size_t n) { n_ = std::min(n_, n); }

  std::size_t size() const { return n_; }
  bool empty() const { return n_ == 0; }
  Corner& operator[](std::size_t i) { return corners_[i]; }
  const Corner& operator[](std::size_t i) const { return corners_[i]; }
  auto begin() { return corners_.begin(); }
  auto end() { return corners_.begin() + static_cast<std::ptrdiff_t>(n_); }
  auto begin() const { return corners_.begin(); }
  auto end() const { return corners_.begin() + static_cast<std::ptrdiff_t>(n_); }

 private:
  std::array<Corner, most> corners_;
  std::size_t n_ = 0;
};

/// Clips a polygon to the half-space height(corner) >= 0: one plane of Sutherland and Hodgman's
/// algorithm ("Reentrant polygon clipping", CACM 17, 1974). A convex polygon gains at most one
/// corner.
/// @param height of a corner above the plane; linear over the polygon, in any unit
/// @param between (from, to, s): the corner at fraction s from one corner to the other
template <typename Corner, std::size_t most, typename Height, typename Between>
Polygon<Corner, most> clipped(const Polygon<Corner, most>& polygon, const Height& height,
                              const Between& between) {
  Polygon<Corner, most> inside;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Corner &from = polygon[i], &to = polygon[i + 1 < polygon.size() ? i + 1 : 0];
    const double a = height(from), b = height(to);
    if (a >= 0) inside.add(from);
    if ((a >= 0) != (b >= 0)) inside.add(between(from, to, a / (a - b)));
  }
  return inside;
}

}  // namespace heft
