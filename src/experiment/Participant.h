// A participant's id, and a parameter of a simulated participant.
#pragma once

#include <optional>
#include <string>
#include <variant>

#include "base/Error.h"

namespace heft {

/// An id is one line of printable UTF-8, not blank, of at most 200 bytes. It is kept unchanged.
/// @return a message that continues "the id"; none: the id is valid
std::optional<std::string> wrong_with_id(const std::string& id);

/// A value of a parameter file, with its place for messages.
struct Parameter {
  std::string name;
  std::variant<double, bool, std::string> value;  ///< integers are read as double
  SourcePlace place;
};

}  // namespace heft
