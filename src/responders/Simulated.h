// The simulated participant: a hand, an eye and a judgment, put together. Looks at every cube,
// comes back, answers; looks again when told to try again or when an answer was not taken.
#pragma once

#include <memory>

#include "responders/Responder.h"

namespace heft {

std::unique_ptr<Responder> make_simulated(const ResponderOptions& options);

}  // namespace heft
