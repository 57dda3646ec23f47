// What may be a participant's id.
#pragma once

#include <optional>
#include <string>

namespace heft {

/// What is wrong with it, as it follows "the id"; none where nothing is. An id is text that people
/// can read and tables can hold: UTF-8, one line, not blank, 200 bytes at most. Leading zeros,
/// blanks inside and any script are kept as they are.
std::optional<std::string> wrong_with_id(const std::string& id);

}  // namespace heft
