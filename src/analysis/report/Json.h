// A Summary as JSON, for programs. The names are a contract; what does not exist is null, and there
// is never a NaN or an infinity.
#pragma once

#include <string>

#include "analysis/dataset/Summary.h"

namespace heft {

/// UTF-8, indented by two spaces, ending in a newline. Percentages are 0...100.
std::string as_json(const Summary& summary);

}  // namespace heft
