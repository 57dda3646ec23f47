// Choices of a protocol that both the session's configuration and physics name: the default
// techniques and how poses between two pictures are taken.
#pragma once

#include <array>
#include <string_view>

#include "base/Names.h"

namespace heft {

// The techniques that a protocol need not declare (paper, 4.1).
inline constexpr const char* coupled_technique = "C1";  ///< the clone stays on the effector
inline constexpr const char* spring_technique = "C2";   ///< a spring of the [coupling] table

/// The one of a coupling that is decoupled or not.
constexpr const char* default_technique(bool decoupled) {
  return decoupled ? spring_technique : coupled_technique;
}

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
