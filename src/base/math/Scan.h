// The one scan converter: which points of a grid a triangle covers, and how much of its squares a
// polygon does. Both walk the same edges down the rows. Knows no colors, depths or cameras.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <span>
#include <utility>

namespace heft {

/// Columns begin <= x < end of a row.
struct Span {
  int begin = 0, end = 0;

  int width() const { return end - begin; }
  bool empty() const { return end <= begin; }
  /// The shortest that holds both.
  Span around(const Span& other) const {
    if (empty()) return other;
    if (other.empty()) return *this;
    return {std::min(begin, other.begin), std::max(end, other.end)};
  }
};

namespace scanning {
using Eigen::Vector2d;

/// The first of the lines 0, 1... n at or after a place; n where there is none. For places far
/// outside and for what is not a number, too.
inline int first_line(double place, int n) {
  const double within = std::min(std::max(0.0, place), static_cast<double>(n));
  const int before = static_cast<int>(within);
  return before + (within > before ? 1 : 0);
}

/// A side of a polygon on its way down the rows. Where it crosses a line depends on its ends alone,
/// so that what lies on either side of it parts every row at the same place.
class Edge {
 public:
  Edge(const Vector2d& top, const Vector2d& bottom)
      : top_(top), slope_((bottom.x() - top.x()) / (bottom.y() - top.y())) {}
  double x_at(double y) const { return top_.x() + slope_ * (y - top_.y()); }

 private:
  Vector2d top_;
  double slope_;
};

/// The piece of an edge within one row, from x0 to x1: each square that it crosses is covered to
/// the right of it, each square after it wholly.
template <typename Step>
void cover_right_of(double x0, double x1, double height, int n_columns, const Step& step) {
  if (x0 > x1) std::swap(x0, x1);
  const double width = n_columns, length = x1 - x0;
  if (x0 >= width) return;
  if (x0 < 0) {  // what enters left of the grid covers its row from the first square on
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

/// Calls row(y, begin, end) for every row of which a triangle, of either winding, covers the points
/// begin to before end. Triangles with an edge in common share no point and leave none out.
template <typename Row>
void scan_points(std::array<Eigen::Vector2d, 3> corners, int n_columns, int n_rows,
                 const Row& row) {
  using scanning::first_line, scanning::Edge;
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
      const Span next = span_at(y + 1);  // worked out while this row is drawn
      if (!span.empty()) row(y, span.begin, span.end);
      span = next;
    }
  };
  between(top, middle);
  between(middle, bottom);
}

/// How much of each square (x to x + 1, y to y + 1) of a grid a simple polygon covers, exactly and
/// without samples: calls step(y, x, change) so that the sum of a row's changes up to x is the
/// covered fraction; column n_columns takes what begins beyond it. Clockwise (y down) counts
/// positive.
/// @param grid the corner of square (0, 0), in the polygon's coordinates
template <typename Step>
void scan_areas(std::span<const Eigen::Vector2d> polygon, const Eigen::Vector2d& grid,
                int n_columns, int n_rows, const Step& step) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d from = polygon[i] - grid, to = polygon[(i + 1) % polygon.size()] - grid;
    // An edge up opens the polygon: everything to its right is inside; one down closes it.
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
