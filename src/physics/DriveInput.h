// How measured poses become the target's path: what a protocol chooses of physics/Drive.h.
#pragma once

#include "base/SimulationChoices.h"

namespace heft {

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
