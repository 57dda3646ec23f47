// `boxes`: the decoupling technique on a contact solver for a few boxes on a table. Law:
// physics/coupling/CouplingLaw.h; contacts: boxes/BoxWorld.h.
#pragma once

#include <memory>

#include "physics/DecouplingSimulator.h"

namespace heft {

/// Exact coupling in translation. The orientation is locked to the effector where the torsional
/// spring is stiff enough (as the paper's), otherwise coupled exactly about each axis. Coulomb
/// friction on its disk.
std::unique_ptr<DecouplingSimulator> make_boxes();

}  // namespace heft
