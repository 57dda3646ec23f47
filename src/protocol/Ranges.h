// The numbers that a key takes.
#pragma once

#include <cstdint>
#include <limits>
#include <string>

namespace heft {

/// Beyond this much of any unit lies no experiment, only overflow.
inline constexpr double furthest = 1e12;
/// Below this much of what must be above zero lies only underflow.
inline constexpr double least = 1e-9;

/// The numbers a key takes.
struct Range {
  double low = -furthest, high = furthest;
  bool low_open = false, high_open = false;
  bool holds(double value) const;
  std::string text() const;  ///< what it adds to "a number", e.g. ", at least 0"
};
inline constexpr Range any_number{};
inline constexpr Range above_zero{least, furthest};
inline constexpr Range zero_or_more{0};
/// Places and sizes in meters.
inline constexpr Range on_earth{-1e6, 1e6};
inline constexpr Range size_on_earth{least, 1e6};

/// Whole numbers that a key takes.
struct WholeRange {
  std::int64_t low = 0;
  std::int64_t high = std::numeric_limits<int>::max();
};

}  // namespace heft
