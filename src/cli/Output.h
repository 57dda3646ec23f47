// Data on stdout: a command has done its work only once its output is where it should be.
#pragma once

#include <string>

#include "base/Error.h"

namespace heft::cli {

/// Writes out what was printed so far, so that talk on stderr comes after it.
/// @throws Error when it can't be written
void flush_output();

/// What is said when stdout can't be written.
Error output_error(const std::string& reason);

}  // namespace heft::cli
