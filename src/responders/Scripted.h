// Plays a recording back: a real hand's trajectories and timed actions.
#pragma once

#include <memory>

#include "responders/Responder.h"

namespace heft {

/// @throws Error and InvalidFile as load_recording; at a trial's start, where the recording lacks
///   that trial or has an action that its task does not offer
std::unique_ptr<Responder> make_scripted(const ResponderOptions& options);

}  // namespace heft
