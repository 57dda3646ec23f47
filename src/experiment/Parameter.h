// A named value from a flat parameter file, with its place for messages.
#pragma once

#include <string>
#include <variant>

#include "base/Error.h"

namespace heft {

struct Parameter {
  std::string name;
  std::variant<double, bool, std::string> value;  ///< integers are read as double
  SourcePlace place;
};

}  // namespace heft
