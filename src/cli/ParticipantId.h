// What a participant's id may be.
#pragma once

#include <string>

namespace heft::cli {

/// An id is text that people can read and tables can hold: UTF-8, at most 200 bytes, one line, not
/// blank. Leading zeros, blanks inside and any script are kept as they are.
/// @throws Error (usage) saying what is wrong with it
void check_participant(const std::string& id);

}  // namespace heft::cli
