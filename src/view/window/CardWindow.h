// A display is measured with a bank card, which is as large everywhere (ISO/IEC 7810 ID-1): it is
// held against a rectangle that is made as large as it is.
#pragma once

#include <optional>
#include <string>

#include "experiment/DisplayFacts.h"

namespace heft {

inline constexpr double card_w_mm = 85.60, card_h_mm = 53.98;

struct MeasuredCard {
  DisplayFacts display;
  double w_px = 0;
};

/// Shows the rectangle below the words, full screen. The wheel and the arrow keys change it by a
/// pixel (with Shift ten), dragging the mouse makes it as wide; Enter ends it, Escape without a
/// result.
/// @throws Error (device_missing) when there is no such display
std::optional<MeasuredCard> measure_card(int display, const std::string& how);

}  // namespace heft
