// How poses between two pictures are taken: what a protocol chooses, a session's configuration
// records and physics/Drive does.
#pragma once

#include <array>
#include <string_view>

#include "base/Names.h"

namespace heft {

/// Where the target is between two samples' poses.
enum class InputMode {
  path,         ///< on the way from the last pose to this one: for what is shown over video
  hold,         ///< at the last pose until this one is there: for see-through displays
  extrapolate,  ///< on along the line through the last two poses: for see-through displays
  /// As path, but on the cubic that has the measured velocities at its ends (Hermite's): poses far
  /// apart then bend as the hand did. Straight where no velocity is measured, and as noisy as they
  /// are.
  smooth
};

template <>
struct EnumNames<InputMode> {
  static constexpr std::array<std::string_view, 4> names{"path", "hold", "extrapolate", "smooth"};
};

}  // namespace heft
