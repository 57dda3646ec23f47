#include "tracking/synthetic/AreaRaster.h"

#include <cmath>
#include <utility>

namespace heft {

PixelBox PixelBox::around(const PixelBox& other) const {
  if (empty()) return other;
  if (other.empty()) return *this;
  return {std::min(x0, other.x0), std::min(y0, other.y0), std::max(x1, other.x1),
          std::max(y1, other.y1)};
}

PixelBox pixels_around(std::span<const Eigen::Vector2d> points_px) {
  if (points_px.empty()) return {};
  Eigen::Vector2d low = points_px[0], high = points_px[0];
  for (const Eigen::Vector2d& point : points_px) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  // A pixel reaches half a pixel around its center.
  const auto pixel = [](double px) { return static_cast<int>(std::lround(px)); };
  return {pixel(low.x()), pixel(low.y()), pixel(high.x()) + 1, pixel(high.y()) + 1};
}

void AreaRaster::begin(const PixelBox& box) {
  box_ = box;
  const auto rows = static_cast<std::size_t>(std::max(0, box.height()));
  steps_.assign(rows * static_cast<std::size_t>(std::max(0, box.width()) + 1), Light::Zero());
}

void AreaRaster::add(std::span<const Eigen::Vector2d> polygon_px, const Light& light) {
  if (box_.empty()) return;
  const Eigen::Vector2d origin(box_.x0 - 0.5, box_.y0 - 0.5);
  for (std::size_t i = 0; i < polygon_px.size(); ++i)
    add_edge(polygon_px[i] - origin, polygon_px[(i + 1) % polygon_px.size()] - origin, light);
}

// An edge up the picture opens the polygon: everything to its right is inside; one down closes it.
void AreaRaster::add_edge(const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                          const Light& light) {
  if (from.y() == to.y()) return;
  const bool opens = from.y() > to.y();
  const Eigen::Vector2d& top = opens ? to : from;
  const Eigen::Vector2d& bottom = opens ? from : to;
  const double slope = (bottom.x() - top.x()) / (bottom.y() - top.y());
  const double begin = std::max(top.y(), 0.0);
  const double end = std::min(bottom.y(), static_cast<double>(box_.height()));
  for (auto row = static_cast<int>(begin); row < end; ++row) {
    const double y0 = std::max<double>(begin, row), y1 = std::min<double>(end, row + 1);
    if (y1 <= y0) continue;
    add_in_row(steps_.data() + row * (box_.width() + 1), top.x() + slope * (y0 - top.y()),
               top.x() + slope * (y1 - top.y()), opens ? y1 - y0 : y0 - y1, light);
  }
}

// The piece of an edge that lies in one row, from x0 to x1: each pixel that it crosses is covered
// to the right of it, each pixel after it wholly.
void AreaRaster::add_in_row(Light* row, double x0, double x1, double height,
                            const Light& light) const {
  if (x0 > x1) std::swap(x0, x1);
  const double width = box_.width(), length = x1 - x0;
  if (x0 >= width) return;
  if (x0 < 0) {  // what enters left of the box covers its rows from the first pixel on
    const double outside = x1 <= 0 ? 1 : -x0 / length;
    row[0] += static_cast<float>(height * outside) * light;
    if (x1 <= 0) return;
  }
  const double end = std::min(x1, width);
  for (double from = std::max(x0, 0.0);;) {
    const int pixel = std::min(static_cast<int>(from), box_.width() - 1);
    const double to = std::min<double>(end, pixel + 1);
    const double part = length > 0 ? height * (to - from) / length : height;
    const double right = pixel + 1 - (from + to) / 2;
    row[pixel] += static_cast<float>(part * right) * light;
    row[pixel + 1] += static_cast<float>(part * (1 - right)) * light;
    if (to >= end) return;
    from = to;
  }
}

void AreaRaster::draw_behind(LightPicture& picture) const {
  for (int y = 0; y < box_.height(); ++y) {
    const Light* step = steps_.data() + y * (box_.width() + 1);
    Light* out = picture.row(box_.y0 + y) + (box_.x0 - picture.box.x0);
    Light sum = Light::Zero();
    for (int x = 0; x < box_.width(); ++x) {
      sum += step[x];
      if (sum[3] > 1e-5F) out[x] = over(out[x], sum);
    }
  }
}

}  // namespace heft
