// The simulator `auto` of a session: resolved once, before the first trial, for the whole protocol.
#pragma once

#include "physics/auto/Choice.h"
#include "protocol/Protocol.h"

namespace heft {

/// What models all a person may do, at the lowest rate that stays within the tolerance with every
/// technique of the protocol, at least the display's; the protocol's own rate is not asked.
SimulatorPick resolve_auto(const Protocol& protocol);

}  // namespace heft
