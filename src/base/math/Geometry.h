// Overlap of oriented boxes, and convex polygons of few corners with the one way of clipping them.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "base/PoseTypes.h"

namespace heft {

/// Separating-axis test of two boxes given by the poses of their centers and their full sizes.
/// Touching counts as overlapping.
bool boxes_overlap(const Pose& a, const Eigen::Vector3d& size_a_m, const Pose& b,
                   const Eigen::Vector3d& size_b_m);

/// Corners in order, without a heap. What is added beyond `most` is left out.
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

/// The part of a polygon where height(corner) >= 0: one plane of Sutherland and Hodgman's clipper
/// ("Reentrant polygon clipping", CACM 17, 1974). A convex polygon gains at most one corner.
/// @param height of a corner above the plane; linear over the polygon, in any unit
/// @param between (from, to, s): the corner a fraction s of the way from one to the other
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
