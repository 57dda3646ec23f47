// Scan conversion: the grid points that a triangle covers, and the area that a polygon covers of
// each grid square.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <span>
#include <utility>

namespace heft {

/// Columns begin <= x < end of one row.
struct Span {
  int begin = 0, end = 0;

  int width() const { return end - begin; }
  bool empty() const { return end <= begin; }
  /// The shortest span that holds both.
  Span around(const Span& other) const {
    if (empty()) return other;
    if (other.empty()) return *this;
    return {std::min(begin, other.begin), std::max(end, other.end)};
  }
};

namespace scanning {
using Eigen::Vector2d;

/// The smallest of 0, 1... n that is at least `place`; n when all are smaller. Safe for any finite
/// place and for NaN.
inline int first_line(double place, int n) {
  const double within = std::min(std::max(0.0, place), static_cast<double>(n));
  const int before = static_cast<int>(within);
  return before + (within > before ? 1 : 0);
}

/// A side of a polygon. Its crossing of a row depends on its end points only, so that polygons on
/// both sides split every row at the same place.
class Edge {
 public:
  Edge(const Vector2d& top, const Vector2d& bottom)
      : top_(top), slope_((bottom.x() - top.x()) / (bottom.y() - top.y())) {}
  double x_at(double y) const { return top_.x() + slope_ * (y - top_.y()); }

 private:
  Vector2d top_;
  double slope_;
};

/// The part of an edge within one row, from x0 to x1, covers the squares to its right: those it
/// crosses in part, the others fully.
template <typename Step>
void cover_right_of(double x0, double x1, double height, int n_columns, const Step& step) {
  if (x0 > x1) std::swap(x0, x1);
  const double width = n_columns, length = x1 - x0;
  if (x0 >= width) return;
  if (x0 < 0) {  // the part left of the grid covers the whole row
    step(0, height * (x1 <= 0 ? 1 : -x0 / length));
    if (x1 <= 0) return;
  }
  const double end = std::min(x1, width);
  for (double from = std::max(x0, 0.0);;) {
    const int x = std::min(static_cast<int>(from), n_columns - 1);
    const double to = std::min<double>(end, x + 1);
    const double part = length > 0 ? height * (to - from) / length : height;
    const double right = x + 1 - (from + to) / 2;
    step(x, part * right);
    step(x + 1, part * (1 - right));
    if (to >= end) return;
    from = to;
  }
}
}  // namespace scanning

/// Calls row(y, begin, end) for every row in which a triangle of either winding covers the points
/// begin <= x < end. Triangles with a common edge neither share points nor leave gaps.
template <typename Row>
void scan_points(const std::array<Eigen::Vector2d, 3>& triangle, int n_columns, int n_rows,
                 const Row& row) {
  using scanning::first_line, scanning::Edge;
  std::array<Eigen::Vector2d, 3> corners = triangle;
  std::ranges::sort(corners, [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.y() != b.y() ? a.y() < b.y() : a.x() < b.x();
  });
  const auto& [top, middle, bottom] = corners;
  const Edge whole(top, bottom);
  const Eigen::Vector2d down = bottom - top, part = middle - top;
  const bool whole_is_left = down.x() * part.y() < down.y() * part.x();
  const auto between = [&](const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
    const Edge side(from, to);
    const Edge &left = whole_is_left ? whole : side, &right = whole_is_left ? side : whole;
    const auto span_at = [&](int y) {
      return Span{first_line(left.x_at(y), n_columns), first_line(right.x_at(y), n_columns)};
    };
    int y = first_line(from.y(), n_rows);
    const int end_row = first_line(to.y(), n_rows);
    for (Span span = span_at(y); y < end_row; ++y) {
      const Span next = span_at(y + 1);  // computed while the caller draws this row
      if (!span.empty()) row(y, span.begin, span.end);
      span = next;
    }
  };
  between(top, middle);
  between(middle, bottom);
}

/// Exact area coverage of the squares (x to x + 1, y to y + 1) of a grid by a simple polygon. Calls
/// step(y, x, change); the covered fraction of a square is the sum of its row's changes up to x.
/// Column n_columns collects changes beyond the last square. Clockwise polygons (y down) count
/// positive.
/// @param grid the corner of square (0, 0), in the polygon's coordinates
template <typename Step>
void scan_areas(std::span<const Eigen::Vector2d> polygon, const Eigen::Vector2d& grid,
                int n_columns, int n_rows, const Step& step) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d from = polygon[i] - grid, to = polygon[(i + 1) % polygon.size()] - grid;
    // To the right of a rising edge is the inside of the polygon, of a falling edge the outside.
    const bool opens = from.y() > to.y();
    const Eigen::Vector2d &top = opens ? to : from, &bottom = opens ? from : to;
    const double begin = std::max(top.y(), 0.0);
    const double end = std::min(bottom.y(), static_cast<double>(n_rows));
    if (!(begin < end)) continue;
    const scanning::Edge edge(top, bottom);
    for (auto y = static_cast<int>(begin); y < end; ++y) {
      const double y0 = std::max<double>(begin, y), y1 = std::min<double>(end, y + 1);
      scanning::cover_right_of(edge.x_at(y0), edge.x_at(y1), opens ? y1 - y0 : y0 - y1, n_columns,
                               [&](int x, double change) { step(y, x, change); });
    }
  }
}

}  // namespace heft
