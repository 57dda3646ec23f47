// heft procedure: procedures for programs in any language. --help shows the formats.
#include <fmt/format.h>

#include <csignal>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "cli/Commands.h"
#include "cli/commands/ProcedureDialog.h"
#include "protocol/readers/Files.h"
#include "psychophysics/ProcedureKinds.h"

namespace heft::cli {

namespace {
void converse(const std::string& file, bool with_posterior) {
  std::signal(SIGPIPE, SIG_IGN);  // a closed pipe is reported as an error
  std::ios::sync_with_stdio(false);
  ProcedureDialog(load_procedure(file), std::cout, with_posterior).run(std::cin);
}

// The keys of a procedure file, from their declarations.
std::vector<std::string> keys_of_files() {
  std::vector<std::string> lines{"", "Keys of a procedure file: seed,"};
  const auto add = [&](const ConfigKey& key, const auto&...) {
    lines.push_back(
        fmt::format("  {:<18}{}{}", key.name, key.meaning, key.is_required ? " (required)" : ""));
  };
  const InterleaveConfig interleaving{};
  visit_keys(interleaving, add);
  lines.emplace_back("and of each [[staircase]] name, kind, and by kind:");
  ProcedureKinds::for_each([&](const auto& config) {
    lines.push_back(fmt::format(R"(kind = "{}")", config.kind));
    visit_keys(config, add);
  });
  return lines;
}
}  // namespace

void add_procedure(Command& app) {
  std::vector<std::string> lines{
      "heft procedure staircases.toml",
      "",
      "A session (> is written by heft, < is your program's answer, one line per trial):",
      R"(  > {"event":"trial","trial":1,"staircase":"15g","level":175})",
      R"(  < {"response":true}                 perceived, correct: the level goes down)",
      R"(  > {"event":"trial","trial":2,"staircase":"15g","level":125})",
      R"(  < {"void":true}                     the staircase is unchanged, a new trial is drawn)",
      R"(  > {"event":"trial","trial":3,"staircase":"15g","level":125})",
      R"(  < {"response":false,"level":124.5}  the presented level, if it differs)",
      R"(  > {"event":"reversal","staircase":"15g","trial":3,"number":1,"level":124.5,)"
      R"("step_before":50,"step_after":50})",
      R"(  > {"event":"trial","trial":4,"staircase":"15g","level":175})",
      "  ...",
      R"(  > {"event":"finished","staircase":"15g","reason":"reversals","estimate":112.5,)"
      R"("low":null,"high":null,"n_trials":19})",
      R"(  > {"event":"done"})",
      "",
      R"(Where two stimuli are compared, {"answer":"comparison"|"reference"|"none"} says which was)",
      "more. Every kind takes it as a response: any choice is true, none is false.",
      R"(A kind that ends by "trials" alone, such as "constant", estimates null; low and high are)",
      "the ends of the estimate's interval, null where the kind gives none.",
      R"(Bayesian kinds add "sd" and "censored" to finished. The estimate is null if)",
      R"(the posterior is not inside its grid ("above": only low is known, "below":)",
      R"(only high) or if the answers do not depend on the level ("indeterminate").)",
      R"(Otherwise "parameters" has each parameter's mean, SD, mode and 95 % interval.)",
      "With --posterior they write these after each answer; the mode is that of all",
      "parameters together:",
      R"(  > {"event":"posterior","staircase":"15g","trial":3,"parameters":)"
      R"({"threshold":{"mean":88.5,"sd":20.5,"mode":85,"low":49.5,"high":130},...}})",
      R"(and with each trial the "recommended" level.)",
      R"(Invalid input is answered by {"event":"error","line":N,"message":...}; the trial)",
      "stays open. It ends, with exit code 0, when all staircases are done or its input ends."};
  for (std::string& line : keys_of_files()) lines.push_back(std::move(line));
  Command command = app.add_command(
      "procedure", "adaptive procedures for other programs, over JSON lines", lines);
  const auto file = std::make_shared<std::string>();
  command
      .add_option("FILE", file.get(), "procedure file (TOML): seed, interleave, [[staircase]]...")
      .required();
  const auto with_posterior = std::make_shared<bool>(false);
  command.add_flag("--posterior", *with_posterior,
                   "write the posterior of Bayesian kinds after each answer");
  command.does([file, with_posterior] { converse(*file, *with_posterior); });
}

}  // namespace heft::cli
