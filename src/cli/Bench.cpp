// heft bench: the studies of results/.
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "bench/Study.h"
#include "cli/Commands.h"
#include "cli/Talk.h"

namespace heft::cli {

namespace {

struct Options {
  std::string out;
  bool quick = false;
};

void bench(const StudyEntry& study, const Options& options) {
  StudyOptions study_options;
  study_options.out = options.out.empty() ? fmt::format("results/{}", study.name) : options.out;
  study_options.quick = options.quick;
  study_options.command =
      fmt::format("heft bench {}{}{}", study.name, options.quick ? " --quick" : "",
                  options.out.empty() ? "" : " --out " + options.out);
  std::filesystem::create_directories(study_options.out);
  study.run(study_options);
  say("written to {}/\n", study_options.out);
}

}  // namespace

void add_bench(CLI::App& app) {
  CLI::App* command =
      add_command(app, "bench", "measure: the studies that results/ holds, each with its charts",
                  {"heft bench physics", "heft bench tracking --quick --out try/tracking"});
  command->require_subcommand(1);
  for (const StudyEntry& study : studies()) {
    const auto options = std::make_shared<Options>();
    CLI::App* one = command->add_subcommand(std::string(study.name), std::string(study.summary));
    one->add_option("--out", options->out, "folder for its files; default: results/NAME");
    one->add_flag("--quick", options->quick, "a small part of it, to see that it works");
    one->callback([options, &study] { bench(study, *options); });
  }
}

}  // namespace heft::cli
