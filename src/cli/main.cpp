// The program heft. `heft bench` is another one, heft-bench, which has the studies and what only
// they need.
#include "cli/Commands.h"

namespace {

void add_all(heft::cli::Command& app) {
  heft::cli::add_commands(app);
  app.add_command("bench", "measure: the studies that results/ holds (starts heft-bench)");
}

}  // namespace

int main(int argc, char** argv) {
  return heft::cli::run_program(
      {"heft", "Heft runs psychophysics experiments on perceived mass in augmented reality.",
       "Start with: heft demo. Each command explains itself: heft COMMAND --help", add_all},
      argc, argv);
}
