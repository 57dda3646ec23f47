// The program heft. `heft bench` starts heft-bench, which has the studies and their dependencies.
#include "cli/Commands.h"

namespace {

void add_all(heft::cli::Command& app) {
  heft::cli::add_commands(app);
  app.add_command("bench", "run the studies of results/ (starts heft-bench)").is_minor();
}

}  // namespace

int main(int argc, char** argv) {
  return heft::cli::run_program(
      {"heft", "Heft runs psychophysics experiments on perceived mass in augmented reality.",
       "Start with: heft demo. Help on a command: heft help COMMAND", add_all},
      argc, argv);
}
