// What the techniques `gain` and `speed_limit` share: the clone turns with the hand and is
// displaced from it, by a law while it touches cubes. It is then a coupled clone that follows a
// displaced target, so any simulator can run them.
//
// Touched is what the clone touches, and what it touched that is still between it and the hand: on
// its own way back it pushes nothing. Once nothing is touched any more the displacement returns
// from rest, critically damped with the time constant return_s:
//   d(t) = d(0) (1 + t / return_s) e^(-t / return_s).
// Steps are cut where touching begins and ends, and where the clone has caught up with the hand.
#pragma once

#include <memory>

#include "physics/DecouplingSimulator.h"

namespace heft {

/// The simulator itself, if the scene's clone is not displaced.
std::unique_ptr<DecouplingSimulator> displaced(std::unique_ptr<DecouplingSimulator> simulator,
                                               const Scene& scene);

}  // namespace heft
