#include "protocol/Ranges.h"

#include <fmt/format.h>

#include <cmath>

namespace heft {

bool Range::holds(double value) const {
  return std::isfinite(value) && (low_open ? value > low : value >= low) &&
         (high_open ? value < high : value <= high);
}

std::string Range::text() const {
  std::string text;
  if (low == least)
    text += fmt::format(" above 0 ({} or more)", least);
  else if (low > -furthest)
    text += fmt::format("{} {}", low_open ? " above" : ", at least", low);
  if (high < furthest) text += fmt::format(" and {} {}", high_open ? "below" : "at most", high);
  return text;
}

}  // namespace heft
