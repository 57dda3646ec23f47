// Choices of a protocol that the session's configuration records and physics carries out: default
// techniques and the motion of the effector between two pictures.
#pragma once

#include <array>
#include <string_view>

#include "base/Names.h"

namespace heft {

// Techniques that a protocol can use without declaring them (paper, 4.1).
inline constexpr const char* coupled_technique = "C1";  ///< the clone stays on the effector
inline constexpr const char* spring_technique = "C2";   ///< a spring of the [coupling] table

constexpr const char* default_technique(bool decoupled) {
  return decoupled ? spring_technique : coupled_technique;
}

/// Pose of the effector between two samples.
enum class InputMode {
  path,         ///< linear from the last pose to this one: for video see-through displays
  hold,         ///< the last pose until this one arrives: for optical see-through displays
  extrapolate,  ///< beyond the last two poses on their line: for optical see-through displays
  /// As path, on the cubic Hermite curve with the measured velocities at its ends, so that samples
  /// far apart follow a curved movement. Linear where no velocity is measured. Noise of the
  /// velocities enters the path.
  smooth
};

template <>
struct EnumNames<InputMode> {
  static constexpr std::array<std::string_view, 4> names{"path", "hold", "extrapolate", "smooth"};
};

/// How Drive turns samples into the target's path.
struct DriveInput {
  InputMode mode = InputMode::path;
  /// Time from a sample's capture to its display, over which the effector's pose is predicted.
  /// Above 0 only on optical see-through displays; over video the clone would lead the filmed
  /// effector. A sample without a velocity, such as the first one after a jump or a loss, is not
  /// predicted.
  double predict_s = 0;
};

}  // namespace heft
