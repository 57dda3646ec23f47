// Turns fingers and mouse buttons going down and up into taps: a tap is both on the same target.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace heft {

class Taps {
 public:
  /// A finger's number, or that of the mouse.
  using Pointer = std::int64_t;
  static constexpr Pointer mouse = -1;

  void down(Pointer pointer, const std::string& target) { pressed_[pointer] = target; }

  /// @param target what the pointer left the screen over; none: nothing
  /// @return whether that was a tap on the target
  bool up(Pointer pointer, const std::optional<std::string>& target) {
    const auto press = pressed_.extract(pointer);
    return target && !press.empty() && press.mapped() == *target;
  }

  /// The page turned: no tap may begin on one page and end on the next.
  void forget() { pressed_.clear(); }

  bool holds(std::string_view target) const {
    return std::ranges::any_of(pressed_, [&](const auto& press) { return press.second == target; });
  }

 private:
  std::map<Pointer, std::string> pressed_;
};

}  // namespace heft
