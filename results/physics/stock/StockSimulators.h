// Common implementations of the decoupling technique on stock Bullet, to reproduce them and to map
// their failures. All run condition C1 with a kinematic clone. An unstable world throws an Error.
#pragma once

#include <string_view>

#include "physics/DecouplingSimulator.h"

namespace heft {

/// @return null if there is none of that name
MakeSimulator stock_simulator(std::string_view name);

}  // namespace heft
