// What may be a participant's id.
// A named value from a flat parameter file, with its place for messages.
#pragma once

#include <optional>
#include <string>
#include <variant>

#include "base/Error.h"

namespace heft {

/// What is wrong with it, as it follows "the id"; none where nothing is. An id is text that people
/// can read and tables can hold: UTF-8, one line, not blank, 200 bytes at most. Leading zeros,
/// blanks inside and any script are kept as they are.
std::optional<std::string> wrong_with_id(const std::string& id);

struct Parameter {
  std::string name;
  std::variant<double, bool, std::string> value;  ///< integers are read as double
  SourcePlace place;
};

}  // namespace heft
