// `boxes`: the decoupling technique on our own solver for a handful of boxes on a table. Law:
// physics/coupling/CouplingLaw.h; contacts: boxes/BoxWorld.h.
#pragma once

#include <memory>

#include "physics/DecouplingSimulator.h"

namespace heft {

/// Exact coupling in translation; orientation locked to the effector's where the torsional spring
/// is stiff enough (the paper's is), else exact per axis. Contacts with Coulomb's friction disk.
std::unique_ptr<DecouplingSimulator> make_boxes();

}  // namespace heft
