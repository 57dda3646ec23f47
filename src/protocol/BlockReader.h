// The [[block]] tables of a protocol.
#pragma once

#include "protocol/Protocol.h"
#include "protocol/TableReader.h"
#include "protocol/TechniqueReader.h"

namespace heft {

/// Reads and checks every block; those with mistakes may be left out.
std::vector<Block> read_blocks(TableReader& protocol, const TechniqueNames& techniques);

}  // namespace heft
