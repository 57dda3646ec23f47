// Which pixels of a picture something reaches: of a hand that comes in aslant, less than half of
// the box around it.
#pragma once

#include <algorithm>
#include <vector>

#include "tracking/synthetic/AreaRaster.h"

namespace heft {

/// One span for every row of a box, within the box.
class RowSpans {
 public:
  RowSpans() = default;
  /// Empty ones.
  explicit RowSpans(const PixelBox& box)
      : box_(box), spans_(static_cast<std::size_t>(std::max(0, box.height()))) {}

  /// Of a box, whole rows.
  static RowSpans whole(const PixelBox& box);
  /// From the first to the last pixel of each row that covers something.
  static RowSpans covered(const LightPicture& picture);

  const PixelBox& box() const { return box_; }
  Span& at(int y) { return spans_[static_cast<std::size_t>(y - box_.y0)]; }
  const Span& at(int y) const { return spans_[static_cast<std::size_t>(y - box_.y0)]; }

  /// All that is at most so many columns and rows away, within the box.
  RowSpans grown(int columns, int rows) const;

 private:
  PixelBox box_;
  std::vector<Span> spans_;
};

}  // namespace heft
