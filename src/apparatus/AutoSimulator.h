// The simulator `auto` of a session: resolved once, before the first trial, for the whole protocol.
#pragma once

#include "physics/auto/Choice.h"
#include "protocol/Protocol.h"

namespace heft {

/// The cheapest simulator that models all a person may do and stays within the tolerance in every
/// trial of the protocol; it depends on nothing that happens in a session. Its rate is at least the
/// display's; the protocol's own rate is not asked.
SimulatorPick resolve_auto(const Protocol& protocol);

}  // namespace heft
