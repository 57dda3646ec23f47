// The decoupling technique on Bullet's contact solver. Law and schemes:
// physics/coupling/CouplingLaw.h.
#pragma once

#include <memory>

#include "physics/DecouplingSimulator.h"

namespace heft {

/// bullet-ea: implicit Euler in translation and rotation.
std::unique_ptr<DecouplingSimulator> make_bullet_ea();
/// bullet-x: the exact sampled oscillator in translation and rotation.
std::unique_ptr<DecouplingSimulator> make_bullet_x();
/// bullet-lx: exact in translation, the clone's orientation locked to the effector's. The paper's
/// torsional spring (150 N m/rad on 1e-5 kg m^2) is nearly that stiff. The torsional stiffness of a
/// scene has no effect.
std::unique_ptr<DecouplingSimulator> make_bullet_lx();

}  // namespace heft
