// How measured poses become the target's path: what a protocol chooses of physics/Drive.h.
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

/// How samples become the target's path.
struct DriveInput {
  InputMode mode = InputMode::path;
  /// How much later than its capture a sample's world is seen; the target is where the effector is
  /// predicted to be by then. More than 0 only on see-through displays: over video the clone would
  /// run ahead of the filmed effector. A sample without a velocity, as the first one after a jump
  /// or a loss, is not predicted.
  double predict_s = 0;
};

}  // namespace heft
