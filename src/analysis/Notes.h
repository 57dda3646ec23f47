// What a reader must know about what was counted and what was not.
#pragma once

#include <string>
#include <vector>

#include "analysis/Summary.h"

namespace heft {

/// A sentence each; none where nothing is out of the ordinary.
std::vector<std::string> notes_on(const Dataset& dataset, const Summary& summary);

}  // namespace heft
