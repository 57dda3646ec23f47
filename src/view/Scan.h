// Which points of a grid a triangle covers, row by row.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace heft {

namespace scanning {
// Far outside every picture, and still far from what an int holds.
inline double bounded(double value) {
  return std::clamp(value, -1e8, 1e8);
}

inline int ceil_int(double value) {
  const int truncated = static_cast<int>(value);
  return truncated + (value > truncated ? 1 : 0);
}

// The column where an edge crosses each row, with 32 binary places. It depends on the edge's ends
// alone, so two triangles on either side of it part every row at the same sample.
class Edge {
 public:
  Edge(const Eigen::Vector2d& upper, const Eigen::Vector2d& lower, int n_rows)
      : begin_row(std::clamp(ceil_int(bounded(upper.y())), 0, n_rows)),
        end_row(std::clamp(ceil_int(bounded(lower.y())), 0, n_rows)) {
    if (begin_row >= end_row) return;
    const double slope = (lower.x() - upper.x()) / (lower.y() - upper.y());
    column_ = fixed(bounded(upper.x() + slope * (begin_row - upper.y())));
    step_ = fixed(bounded(slope));  // steeper ones cross one row, and never step
  }
  int column() const { return static_cast<int>((column_ + one - 1) >> 32); }
  void step() { column_ += step_; }

  int begin_row, end_row;

 private:
  static constexpr std::int64_t one = std::int64_t{1} << 32;
  static std::int64_t fixed(double value) { return std::llround(value * static_cast<double>(one)); }
  std::int64_t column_ = 0, step_ = 0;
};

template <typename Row>
void scan_between(Edge& long_edge, Edge short_edge, bool long_is_left, int n_columns,
                  const Row& row) {
  for (int y = short_edge.begin_row; y < short_edge.end_row; ++y) {
    const int left = (long_is_left ? long_edge : short_edge).column();
    const int right = (long_is_left ? short_edge : long_edge).column();
    if (left < n_columns && right > 0 && left < right)
      row(y, std::max(left, 0), std::min(right, n_columns));
    long_edge.step();
    short_edge.step();
  }
}

}  // namespace scanning

/// Calls row(y, begin, end) for every row of which a triangle covers the columns begin to before
/// end. Triangles with an edge in common share no point and leave none out.
template <typename Row>
void scan(std::array<Eigen::Vector2d, 3> corners, int n_columns, int n_rows, const Row& row) {
  std::ranges::sort(corners, [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.y() != b.y() ? a.y() < b.y() : a.x() < b.x();
  });
  const auto& [top, middle, bottom] = corners;
  using scanning::Edge, scanning::scan_between;
  Edge long_edge(top, bottom, n_rows);
  const Eigen::Vector2d whole = bottom - top, part = middle - top;
  const bool long_is_left = whole.x() * part.y() < whole.y() * part.x();
  scan_between(long_edge, Edge(top, middle, n_rows), long_is_left, n_columns, row);
  scan_between(long_edge, Edge(middle, bottom, n_rows), long_is_left, n_columns, row);
}

}  // namespace heft
