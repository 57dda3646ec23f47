// The closed list of the techniques that displace the clone from the hand instead of drawing it
// there by a spring. A further one is a name here and a header beside this one: its parameters with
// visit_keys, after() and return_s, which DisplacedSimulator.h explains, and described().
#pragma once

#include "base/Names.h"
#include "physics/techniques/Gain.h"
#include "physics/techniques/SpeedLimit.h"

namespace heft {

using Displacements = NamedKinds<Gain, SpeedLimit>;
using Displacement = Displacements::Any;

}  // namespace heft
