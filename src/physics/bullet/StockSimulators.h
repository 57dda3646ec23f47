// Other people's set-ups of the decoupling technique, on Bullet as it comes: to reproduce them and
// to chart where they fail. All run condition C1 as a kinematic clone. A world that blows up is
// stopped with an Error instead of going on with figures that mean nothing.
#pragma once

#include <memory>

#include "physics/DecouplingSimulator.h"

namespace heft {

std::unique_ptr<DecouplingSimulator> make_bullet_explicit();
std::unique_ptr<DecouplingSimulator> make_bullet_explicit_held();
std::unique_ptr<DecouplingSimulator> make_bullet_stable_pd();
std::unique_ptr<DecouplingSimulator> make_bullet_exact_velocity();
std::unique_ptr<DecouplingSimulator> make_bullet_soft_rows();
std::unique_ptr<DecouplingSimulator> make_bullet_spring2();

}  // namespace heft
