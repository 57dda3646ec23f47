// The program: subcommands, --version, and errors as messages with exit codes.
#include <fmt/format.h>

#include "base/Error.h"
#include "cli/Commands.h"

namespace heft::cli {

CLI::App* add_command(CLI::App& app, const char* name, const char* summary,
                      std::initializer_list<const char*> examples) {
  CLI::App* command = app.add_subcommand(name, summary);
  std::string footer = "Examples:";
  for (const char* example : examples) footer += fmt::format("\n  {}", example);
  command->footer(footer);
  return command;
}

void add_seed(CLI::App* command, std::optional<std::uint64_t>& seed) {
  command
      ->add_option("--seed", seed,
                   "0...2^63-1; without it a fresh one is drawn, printed and logged")
      ->check(CLI::Range(std::uint64_t{0}, (std::uint64_t{1} << 63) - 1));
}

}  // namespace heft::cli

int main(int argc, char** argv) {
  using namespace heft;
  CLI::App app{"Heft runs psychophysics experiments on perceived mass in augmented reality."};
  app.name("heft");
  app.set_version_flag("--version", std::string("heft ") + HEFT_VERSION);
  app.require_subcommand(1);
  app.footer("Start with: heft demo. Each command explains itself: heft COMMAND --help");
  cli::add_demo(app);
  cli::add_run(app);
  cli::add_resume(app);
  cli::add_simulate(app);
  cli::add_replay(app);
  cli::add_analyse(app);
  cli::add_validate(app);
  cli::add_procedure(app);
  cli::add_scene(app);
  cli::add_doctor(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : static_cast<int>(ExitCode::usage);
  } catch (const InvalidFile& error) {
    fmt::print(stderr, "{}\n", error.what());  // each line starts with file:line:column
    return static_cast<int>(error.exit_code());
  } catch (const Error& error) {
    fmt::print(stderr, "heft: {}\n", error.what());
    return static_cast<int>(error.exit_code());
  }
  return 0;
}
