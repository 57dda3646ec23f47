// What heft and heft-bench have in common: a command line, and errors as messages with exit codes.
#pragma once

#include <string>
#include <vector>

#include "cli/CommandLine.h"

namespace heft::cli {

/// @return the exit code. Where a simulator is asked for that only heft-bench has, heft-bench takes
///   over with the same words.
int run_program(const ProgramDescription& program, int argc, char** argv);

/// Goes on as heft-bench.
/// @throws Error (failed) saying how to get it where it can't be started
[[noreturn]] void become_bench(const std::vector<std::string>& words);

/// The same, with an exit code where it fails.
int become_bench_or_fail(const std::vector<std::string>& words);

}  // namespace heft::cli
