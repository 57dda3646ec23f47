// Simulators of one straight push with one degree of freedom. Both refuse, with OutsideModel, what
// is not such a push.
#pragma once

#include <memory>

#include "physics/DecouplingSimulator.h"

namespace heft {

/// `push`: clone and cube along the stroke, exact between the effector's poses: the free clone and
/// the clone that slides with the cube are damped oscillators in closed form; the times of contact,
/// slip, stop and separation are found and the motion goes on from there. Friction is Coulomb's,
/// contacts are rigid and without bounce.
std::unique_ptr<DecouplingSimulator> make_push();

/// `quasi_static`: no masses in motion at all. The clone lags by min(x_hand, mu M g / k), x_hand
/// being how far the effector has gone since the clone touched the cube (paper, section 3.2).
std::unique_ptr<DecouplingSimulator> make_quasi_static();

}  // namespace heft
