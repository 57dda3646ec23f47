// One file per subcommand; each adds itself to the program. A command's callback does the work,
// writes data to stdout and talk to stderr, and throws Error to end with a message and an exit
// code.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>

namespace heft::cli {

void add_analyse(CLI::App& app);
void add_bench(CLI::App& app);
void add_calibrate(CLI::App& app);
void add_demo(CLI::App& app);
void add_doctor(CLI::App& app);
void add_procedure(CLI::App& app);
void add_replay(CLI::App& app);
void add_resume(CLI::App& app);
void add_run(CLI::App& app);
void add_scene(CLI::App& app);
void add_sheet(CLI::App& app);
void add_simulate(CLI::App& app);
void add_track(CLI::App& app);
void add_validate(CLI::App& app);

/// Adds a subcommand whose --help ends with examples, a line each.
CLI::App* add_command(CLI::App& app, const char* name, const char* summary,
                      std::initializer_list<const char*> examples);

/// Adds --seed N.
/// @param without_it what --help says of that
void add_seed(CLI::App* command, std::optional<std::uint64_t>& seed,
              const std::string& without_it = "a fresh one is drawn, printed and logged");

}  // namespace heft::cli
