// Draws triangles: four samples per pixel in a 2 x 2 grid with a depth each, one solid and one
// translucent layer, and soft shade below both. Independent of cameras and boxes. For a dozen boxes
// this is faster than reading a frame back from a graphics card, because only touched rows and
// columns are processed.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/Image.h"
#include "base/math/Scan.h"

namespace heft {

template <typename Value>
class Layer {
 public:
  Layer(int n_columns, int n_rows)
      : n_columns_(n_columns),
        n_rows_(n_rows),
        values_(static_cast<std::size_t>(n_columns) * static_cast<std::size_t>(n_rows)),
        touched_(static_cast<std::size_t>(n_rows), {n_columns, 0}) {}

  int n_columns() const { return n_columns_; }
  int n_rows() const { return n_rows_; }

  /// The columns of a row that may differ from Value{}.
  Span touched(int row) const { return touched_[static_cast<std::size_t>(row)]; }

  const Value* row(int row) const { return values_.data() + start(row); }

  /// The first of the columns begin to end of a row, for writing.
  Value* write(int row, int begin, int end) {
    Span& span = touched_[static_cast<std::size_t>(row)];
    span = {std::min(span.begin, begin), std::max(span.end, end)};
    return values_.data() + start(row) + begin;
  }

  void clear() {
    for (int y = 0; y < n_rows_; ++y) {
      Span& span = touched_[static_cast<std::size_t>(y)];
      if (!span.empty())
        std::fill_n(values_.data() + start(y) + span.begin, span.end - span.begin, Value{});
      span = {n_columns_, 0};
    }
  }

 private:
  std::size_t start(int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(n_columns_);
  }

  int n_columns_, n_rows_;
  std::vector<Value> values_;
  std::vector<Span> touched_;
};

/// Color of a part of the frame.
struct Surface {
  std::array<std::uint8_t, 3> bgr{};
  double opacity = 1;  ///< below 1: drawn into the translucent layer
  int object = 0;      ///< result of find_object() for a solid surface; 0: none
};

/// A corner of a triangle. Pixel centers are integers.
struct RasterCorner {
  Eigen::Vector2d pixel;
  double value = 0;  ///< fill: 1 / distance, greater is nearer; shade: darkness, 0...1
};

using RasterTriangle = std::array<RasterCorner, 3>;

class Rasterizer {
 public:
  Rasterizer(int width_px, int height_px);

  /// Removes all triangles and surfaces. The cost depends on the area that was drawn.
  void clear();

  /// @return the surface's number, for fill()
  /// @throws Error if there are more than 255
  std::uint8_t add_surface(const Surface& surface);

  /// Draws a triangle, of either winding, where no surface of its layer is nearer. Triangles with a
  /// common edge cover every sample exactly once. Translucent surfaces are visible in front of
  /// solid ones, in any order of drawing; of several only the nearest.
  void fill(const RasterTriangle& triangle, std::uint8_t surface);

  /// Darkens the frame below all surfaces. Overlapping shades multiply, as filters do.
  void shade(const RasterTriangle& triangle);

  /// Paints everything over a frame of blue, green and red of the rasterizer's size.
  /// @param in_front one channel of the same size: how much of the frame, of 255, is in front of
  ///   solid surfaces and shade and remains; translucent ones are painted over it. Null: none
  void paint(Image& frame, const Image* in_front = nullptr) const;

  /// The object whose solid surface is nearest to a pixel, within reach_px.
  std::optional<int> find_object(const Eigen::Vector2d& pixel, double reach_px) const;

 private:
  // A sample holds its nearness above 8 bits of surface number, so that one comparison tests the
  // depth and selects the color. 0 is background.
  using Sample = std::int32_t;
  using Four = std::array<Sample, 4>;  // of a pixel

  struct Paint {
    std::array<std::uint8_t, 3> bgr{};
    int opacity = 256;  // of 256
    int object = 0;
  };

  void shade_row(int y, std::uint8_t* bgr) const;
  void paint_row(int y, std::uint8_t* bgr) const;
  void put_in_front(int y, const std::uint8_t* opacity, const std::uint8_t* below,
                    std::uint8_t* bgr) const;
  Span columns_in(int y) const;
  void paint_pixel(const Four& solid, const Four& glass, std::uint8_t* bgr) const;
  std::array<int, 3> color(Sample solid, Sample glass, const std::uint8_t* below) const;

  std::vector<Paint> paints_;     // by surface number; 0 is no surface
  Layer<Sample> solid_, glass_;   // two rows and columns per pixel
  Layer<std::uint8_t> darkness_;  // of 255, one per pixel
};

}  // namespace heft
