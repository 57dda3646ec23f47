// Data on stdout: a command has done its work only once its output is where it should be.
#pragma once

#include <fmt/format.h>

#include <string>
#include <utility>

#include "base/Error.h"
#include "base/Printable.h"

namespace heft::cli {

/// Prints text for people, in which names and notes of any file may stand: a terminal only shows
/// them.
template <typename... Args>
void print(fmt::format_string<Args...> format, Args&&... args) {
  fmt::print("{}", escaped(fmt::format(format, std::forward<Args>(args)...)));
}

/// Writes out what was printed so far, so that talk on stderr comes after it.
/// @throws Error when it can't be written
void flush_output();

/// What is said when stdout can't be written.
Error output_error(const std::string& reason);

}  // namespace heft::cli
