// The names of the two techniques that a protocol need not declare (paper, 4.1). Everything else
// takes a technique's name from the protocol or the log.
#pragma once

namespace heft {

inline constexpr const char* coupled_technique = "C1";  ///< the clone stays on the effector
inline constexpr const char* spring_technique = "C2";   ///< a spring of the [coupling] table

/// The one of a coupling that is decoupled or not.
constexpr const char* default_technique(bool decoupled) {
  return decoupled ? spring_technique : coupled_technique;
}

}  // namespace heft
