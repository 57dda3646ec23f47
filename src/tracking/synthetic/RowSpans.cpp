#include "tracking/synthetic/RowSpans.h"

namespace heft {

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
