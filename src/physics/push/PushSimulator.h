// Simulators of one straight push with one degree of freedom. They throw OutsideModel for all other
// movements.
#pragma once

#include <memory>

#include "physics/DecouplingSimulator.h"

namespace heft {

/// `push`: clone and cube along the stroke, exact between the effector's poses. The free clone and
/// the clone that slides with the cube are damped oscillators in closed form; the motion is divided
/// at contact, slip, stop and separation. Coulomb friction, rigid contacts, no restitution.
std::unique_ptr<DecouplingSimulator> make_push();

/// `quasi_static`: without inertia. The clone lags by min(x_hand, mu M g / k), where x_hand is the
/// distance that the effector has moved since the clone touched the cube (paper, section 3.2).
std::unique_ptr<DecouplingSimulator> make_quasi_static();

}  // namespace heft
