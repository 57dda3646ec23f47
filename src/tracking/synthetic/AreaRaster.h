// Draws polygons by exact area: a pixel gets the part of a polygon's light that equals the
// polygon's coverage of it, computed in closed form along its edges, without sampling. Light of
// polygons side by side or on each other in one body adds up, so a printed face is its paper plus
// (ink - paper) times the black cells, without seams.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <span>
#include <vector>

#include "base/math/Scan.h"

namespace heft {

/// Linear light: blue, green, red, each times the coverage, and the coverage (0...1).
using Light = Eigen::Array4f;

/// Pixels x0 <= x < x1, y0 <= y < y1.
struct PixelBox {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;

  int width() const { return x1 - x0; }
  int height() const { return y1 - y0; }
  bool empty() const { return x1 <= x0 || y1 <= y0; }
  std::size_t area() const {
    return empty() ? 0 : static_cast<std::size_t>(width()) * static_cast<std::size_t>(height());
  }
  bool holds(int x, int y) const { return x >= x0 && x < x1 && y >= y0 && y < y1; }
  PixelBox grown(int by) const { return {x0 - by, y0 - by, x1 + by, y1 + by}; }
  PixelBox within(const PixelBox& other) const {
    return {std::max(x0, other.x0), std::max(y0, other.y0), std::min(x1, other.x1),
            std::min(y1, other.y1)};
  }
  /// The smallest box around both.
  PixelBox around(const PixelBox& other) const;
};

/// Fine pixels per picture pixel in each direction. An edge blurred with 0.6 px and sampled at
/// whole pixels would deviate from the normal distribution by up to 0.06 of its height; with fine
/// pixels it is 0.011.
inline constexpr int fineness = 2;

/// The picture's pixels that contain any of these fine ones, and the fine ones of a picture's.
PixelBox coarse_of(const PixelBox& fine);
PixelBox fine_of(const PixelBox& coarse);

/// The pixels that contain any part of these points' bounding box.
PixelBox pixels_around(std::span<const Eigen::Vector2d> points_px);

/// A part of a picture in linear light.
struct LightPicture {
  PixelBox box;
  std::vector<Light> light;  ///< rows from the top

  LightPicture() = default;
  explicit LightPicture(const PixelBox& of) { reset(of); }
  void reset(const PixelBox& of) {
    box = of;
    light.assign(of.area(), Light::Zero());
  }
  Light* row(int y) { return light.data() + (y - box.y0) * box.width(); }
  const Light* row(int y) const { return light.data() + (y - box.y0) * box.width(); }
  std::span<Light> part(int y, const Span& span) {
    return {row(y) + (span.begin - box.x0), static_cast<std::size_t>(span.width())};
  }
};

/// `top` in front of `under`. Pictures are drawn from front to back, so that hidden parts are
/// skipped.
inline Light over(const Light& top, const Light& under) {
  return top + (1 - top[3]) * under;
}

class AreaRaster {
 public:
  /// Starts a new polygon sum; clipped to the box.
  void begin(const PixelBox& box);

  /// Adds a simple polygon; clockwise in the picture (y down) is positive.
  void add(std::span<const Eigen::Vector2d> polygon_px, const Light& light);

  /// Draws the sum behind the picture's content. The picture's box contains this one's.
  void draw_behind(LightPicture& picture) const;

  const PixelBox& box() const { return box_; }

 private:
  PixelBox box_;
  std::vector<Light> steps_;  ///< for each row, the changes from pixel to pixel; width + 1 values
};

/// One span for each row of a box, within the box.
class RowSpans {
 public:
  RowSpans() = default;
  /// Empty spans.
  explicit RowSpans(const PixelBox& box)
      : box_(box), spans_(static_cast<std::size_t>(std::max(0, box.height()))) {}

  /// Whole rows of a box.
  static RowSpans whole(const PixelBox& box);
  /// From the first to the last covered pixel of each row.
  static RowSpans covered(const LightPicture& picture);

  const PixelBox& box() const { return box_; }
  Span& at(int y) { return spans_[static_cast<std::size_t>(y - box_.y0)]; }
  const Span& at(int y) const { return spans_[static_cast<std::size_t>(y - box_.y0)]; }

  /// The picture's pixels that contain any of these fine ones.
  RowSpans coarse() const;
  /// Spans extended by columns and rows, within the box.
  RowSpans grown(int columns, int rows) const;

 private:
  PixelBox box_;
  std::vector<Span> spans_;
};

}  // namespace heft
