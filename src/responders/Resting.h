// Responders whose hand stays at rest and whose answers owe nothing to what the cubes do: always
// yes, always no, a coin, a criterion with noise alone. Baselines for every analysis.
#pragma once

#include <memory>

#include "responders/Responder.h"

namespace heft {

std::unique_ptr<Responder> make_always_yes(const ResponderOptions& options);
std::unique_ptr<Responder> make_always_no(const ResponderOptions& options);
std::unique_ptr<Responder> make_coin(const ResponderOptions& options);
std::unique_ptr<Responder> make_criterion_only(const ResponderOptions& options);

}  // namespace heft
