// Where the hand's work went: a balance that needs no other simulator to compare with.
#pragma once

#include <optional>

#include "bench/physics/SceneRun.h"

namespace heft {

/// Of a whole run, joules. The clone's turning is left out.
struct EnergyBalance {
  double hand_work_j = 0;  ///< on the spring and its damper; of a coupled clone, on the cubes
  double damped_j = 0;     ///< by the coupling
  double rubbed_j = 0;     ///< by the table, a quarter of each cube's weight on each of its corners
  double stored_j = 0;     ///< more at the end than at the start: spring, motion, height

  /// What hits and rubbing between boxes took. Below zero: what came from nowhere.
  double left_j() const { return hand_work_j - damped_j - rubbed_j - stored_j; }
};

/// @param track with a state for every step, so that each has steady pushes
/// @return none where cubes stand on each other, or the effector goes out of view
std::optional<EnergyBalance> energy_balance(const SceneTrack& track, const BenchScene& scene);

}  // namespace heft
