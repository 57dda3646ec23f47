#include "tracking/synthetic/AreaRaster.h"

#include <cmath>

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
  // A pixel extends half a pixel around its center.
  const auto pixel = [](double px) { return static_cast<int>(std::lround(px)); };
  return {pixel(low.x()), pixel(low.y()), pixel(high.x()) + 1, pixel(high.y()) + 1};
}

PixelBox coarse_of(const PixelBox& fine) {
  const auto up = [](int place) { return (place + fineness - 1) / fineness; };
  return {fine.x0 / fineness, fine.y0 / fineness, up(fine.x1), up(fine.y1)};
}

PixelBox fine_of(const PixelBox& coarse) {
  return {coarse.x0 * fineness, coarse.y0 * fineness, coarse.x1 * fineness, coarse.y1 * fineness};
}

void AreaRaster::begin(const PixelBox& box) {
  box_ = box;
  const auto rows = static_cast<std::size_t>(std::max(0, box.height()));
  steps_.assign(rows * static_cast<std::size_t>(std::max(0, box.width()) + 1), Light::Zero());
}

void AreaRaster::add(std::span<const Eigen::Vector2d> polygon_px, const Light& light) {
  if (box_.empty()) return;
  scan_areas(polygon_px, {box_.x0 - 0.5, box_.y0 - 0.5}, box_.width(), box_.height(),
             [&](int y, int x, double change) {
               steps_[static_cast<std::size_t>(y * (box_.width() + 1) + x)] +=
                   static_cast<float>(change) * light;
             });
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

RowSpans RowSpans::whole(const PixelBox& box) {
  RowSpans spans(box);
  for (Span& span : spans.spans_) span = {box.x0, box.x1};
  return spans;
}

RowSpans RowSpans::covered(const LightPicture& picture) {
  RowSpans spans(picture.box);
  for (int y = picture.box.y0; y < picture.box.y1; ++y) {
    const Light* row = picture.row(y) - picture.box.x0;
    Span& span = spans.at(y);
    span = {picture.box.x0, picture.box.x1};
    while (!span.empty() && row[span.begin][3] <= 0) ++span.begin;
    while (!span.empty() && row[span.end - 1][3] <= 0) --span.end;
  }
  return spans;
}

RowSpans RowSpans::coarse() const {
  RowSpans all(coarse_of(box_));
  for (int y = box_.y0; y < box_.y1; ++y) {
    const Span& fine = at(y);
    if (fine.empty()) continue;
    const PixelBox box = coarse_of({fine.begin, y, fine.end, y + 1});
    all.at(box.y0) = all.at(box.y0).around({box.x0, box.x1});
  }
  return all;
}

RowSpans RowSpans::grown(int columns, int rows) const {
  RowSpans all(box_);
  for (int y = box_.y0; y < box_.y1; ++y) {
    Span& span = all.at(y);
    for (int near = std::max(box_.y0, y - rows); near < std::min(box_.y1, y + rows + 1); ++near)
      span = span.around(at(near));
    if (!span.empty())
      span = {std::max(box_.x0, span.begin - columns), std::min(box_.x1, span.end + columns)};
  }
  return all;
}

}  // namespace heft
