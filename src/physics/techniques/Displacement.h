// The closed list of the techniques that displace the clone from the hand instead of drawing it
// there by a spring. A further one is a name here and a header beside this one: its parameters with
// visit_keys, after() and return_s, which DisplacedSimulator.h explains, and described().
//
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

#include "base/Names.h"
#include "physics/techniques/Gain.h"
#include "physics/techniques/SpeedLimit.h"

namespace heft {

class DecouplingSimulator;
struct Scene;

using Displacements = NamedKinds<Gain, SpeedLimit>;
using Displacement = Displacements::Any;

/// The simulator itself, if the scene's clone is not displaced.
std::unique_ptr<DecouplingSimulator> displaced(std::unique_ptr<DecouplingSimulator> simulator,
                                               const Scene& scene);

}  // namespace heft
