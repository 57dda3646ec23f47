// How far off each simulator is, by what a scene asks of it: what `heft bench physics` measured
// (results/physics/errors.csv), without timings, so that a choice made from it is the same on every
// machine. Only simulators that `auto` may take are in it.
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "base/Names.h"

namespace heft {

/// What a simulator has to be able to do for a scene.
enum class SceneClass {
  free_air,  ///< nothing is touched
  push,      ///< one cube, straight, through its center
  turn,      ///< one cube that turns
  press,     ///< against something that does not give way
  several,   ///< more than one cube is touched, or cubes touch cubes
  rough      ///< fast, noisy, interrupted
};

template <>
struct EnumNames<SceneClass> {
  static constexpr std::array<std::string_view, 6> names{"free_air", "push",    "turn",
                                                         "press",    "several", "rough"};
};

/// The worst of the bench's scenes of a class with the paper's springs that the simulator models.
struct KnownError {
  std::string_view simulator;
  double rate_hz;
  SceneClass scene_class;
  double clone_rms_mm;
  double lag_g;  ///< how much heavier or lighter a cube seems
};

/// Simulators from the cheapest to the most expensive, each one's rates ascending.
std::span<const KnownError> known_errors();

/// The simulators that `auto` may take, the cheapest first.
inline constexpr std::array<std::string_view, 4> ladder_of_simulators{"quasi_static", "push",
                                                                      "boxes", "bullet-lx"};

}  // namespace heft
