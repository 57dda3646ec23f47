// The program heft-bench: the studies of results/, and the commands of heft with the simulators
// that only the studies need.
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <random>

#include "cli/Commands.h"
#include "cli/console/Terminal.h"
#include "results/Study.h"

namespace {

struct Options {
  std::string out;
  std::optional<std::uint64_t> seed;
  bool quick = false;
};

void run(const heft::StudyEntry& study, const Options& options) {
  heft::StudyOptions study_options;
  study_options.out = options.out.empty() ? fmt::format("results/{}", study.name) : options.out;
  study_options.quick = options.quick;
  study_options.seed = options.seed.value_or(std::random_device()());
  heft::cli::say("seed {}\n", study_options.seed);
  study_options.command = fmt::format("heft bench {} --seed {}{}{}", study.name, study_options.seed,
                                      options.quick ? " --quick" : "",
                                      options.out.empty() ? "" : " --out " + options.out);
  std::filesystem::create_directories(study_options.out);
  study.run(study_options);
  heft::cli::say("wrote the results to {}/\n", study_options.out);
}

void add_all(heft::cli::Command& app) {
  for (const heft::StudyEntry& study : heft::studies()) {
    const auto options = std::make_shared<Options>();
    heft::cli::Command command =
        app.add_command(std::string(study.name), std::string(study.summary));
    command.add_option("--out", &options->out, "folder for the results; default: results/NAME");
    command.add_seed(options->seed, "a new one is drawn and printed");
    command.add_flag("--quick", options->quick, "a short run, to check that it works");
    command.does([options, &study] { run(study, *options); });
  }
  heft::cli::add_commands(app);
}

}  // namespace

int main(int argc, char** argv) {
  return heft::cli::run_program(
      {"heft-bench",
       "The studies of results/: each writes its measurements and charts. The other commands are "
       "those of heft, here also with simulators that are known to fail.",
       "Start with: heft bench physics --quick --out try/physics", add_all},
      argc, argv);
}
