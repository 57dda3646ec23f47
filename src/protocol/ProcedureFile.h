// Procedure files: procedures alone, for `heft procedure`. The same keys are used inside
// protocols.
#pragma once

#include <string>

#include "psychophysics/Interleaving.h"

namespace heft {

/// @throws InvalidFile with every mistake at its line and column
InterleavedProcedures parse_procedure(const std::string& text, const std::string& file);

/// @throws Error when the file can't be read, InvalidFile as parse_procedure
InterleavedProcedures load_procedure(const std::string& path);

}  // namespace heft
