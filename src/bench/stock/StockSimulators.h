// Other people's set-ups of the decoupling technique, on Bullet as it comes: to reproduce them and
// to chart where they fail. All run condition C1 as a kinematic clone. A world that blows up is
// stopped with an Error instead of going on with figures that mean nothing.
#pragma once

namespace heft {

/// Makes the simulators that the table names for the studies alone.
void supply_stock_simulators();

}  // namespace heft
