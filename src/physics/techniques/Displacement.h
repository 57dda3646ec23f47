// Techniques that displace the clone from the hand instead of coupling it by a spring. The list is
// closed; a further technique is one header beside this one (its parameters with visit_keys,
// after(), return_s and described()) and its name here.
//
// Their common part, DisplacedSimulator: the clone has the hand's orientation and is displaced by a
// law while it touches cubes. To a simulator it is a coupled clone that follows a displaced target.
// Touched cubes are those that the clone touches, and those that it has touched and that are still
// between it and the hand, so that it pushes nothing on its way back. After the last contact, the
// displacement decays from rest, critically damped with time constant return_s:
//   d(t) = d(0) (1 + t / return_s) e^(-t / return_s).
// Steps are divided where contacts begin and end, and where the clone reaches the hand.
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

/// Wraps a simulator for a scene with a displaced clone; returns it unchanged for other scenes.
std::unique_ptr<DecouplingSimulator> displaced(std::unique_ptr<DecouplingSimulator> simulator,
                                               const Scene& scene);

}  // namespace heft
