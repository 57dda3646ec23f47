// Whole numbers on the command line: decimal digits and nothing else, so that 010 is not read as
// octal 8, nor 1e3 as 1.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>

namespace heft::cli {

/// Accepts least...most without sign, spaces or leading zeros.
CLI::Validator whole_number(std::uint64_t least, std::uint64_t most);

/// For --session.
CLI::Validator session_number();

}  // namespace heft::cli
