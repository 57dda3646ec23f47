// Other people's set-ups of the decoupling technique, on Bullet as it comes: to reproduce them and
// to chart where they fail. All run condition C1 as a kinematic clone. A world that blows up is
// stopped with an Error instead of going on with figures that mean nothing.
#pragma once

#include <string_view>

#include "physics/DecouplingSimulator.h"

namespace heft {

/// @return null where none has that name
MakeSimulator stock_simulator(std::string_view name);

}  // namespace heft
