// The same law on another engine, Open Dynamics Engine 0.16: the independent half of a converged
// reference. Forces are explicit, as the paper writes them, so it needs steps of some 20 us.
// Contacts may give: ODE's own springs and dampers then, as stiff as the scene says and critically
// damped. Only where the library was there at build time.
#pragma once

#include <memory>

#include "physics/DecouplingSimulator.h"

namespace heft {

/// Steps a second at which it is meant to run.
inline constexpr int ode_rate_hz = 48000;

/// @return nothing where Heft was built without ODE
std::unique_ptr<DecouplingSimulator> make_ode_simulator();

}  // namespace heft
