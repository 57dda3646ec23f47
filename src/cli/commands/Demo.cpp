// heft demo: the paper's whole session with a simulated responder, and what was found.
#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <memory>

#include "analysis/dataset/Summary.h"
#include "analysis/report/Notes.h"
#include "analysis/report/Report.h"
#include "analysis/report/Tables.h"
#include "base/Program.h"
#include "cli/Commands.h"
#include "cli/SessionOptions.h"
#include "cli/console/Terminal.h"
#include "session/Session.h"

namespace heft::cli {

namespace {

struct DemoOptions {
  std::string out = "heft-demo";
  std::optional<std::uint64_t> seed;
};

// The shortest session of 90 seeds: who hesitates more takes twice as long.
constexpr std::uint64_t usual_seed = 75;

SessionRequest demo_session(const DemoOptions& options) {
  SessionOptions given;
  given.responder = Plug{"simulated"};
  given.tracker = Plug{"synthetic"};
  SessionRequest request{resolve(given, load_protocol(installed_file("protocols/paper.toml")),
                                 options.seed.value_or(usual_seed)),
                         "demo", options.out + "/demo.db"};
  request.again = true;
  return request;
}

void demo(const DemoOptions& options) {
  std::filesystem::create_directories(options.out);
  const SessionRequest request = demo_session(options);
  const auto started = std::chrono::steady_clock::now();
  say("The paper's session: demonstration, introduction, 10 sorting trials, three interleaved "
      "staircases.\nA rendered camera films a simulated participant's hand, the effector's tags "
      "are found in its\npictures, physics pushes back, and everything is logged; seed {}.\n",
      request.config->seed);
  const SessionResult result =
      run_session({request.config, request.db},
                  [&](const RunnerOptions& runner) { return start_session(request, runner); });
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - started;

  const std::string report = options.out + "/report";
  const Summary summary =
      analyze({{request.db},
               {result.session_id},
               false,
               fmt::format("heft analyse --db {} --session {} --out {}", shell_quoted(request.db),
                           result.session_id, shell_quoted(report))});
  print("{}", readable(summary));
  flush_output();
  explain_missing_charts(write_report(summary, report), report);
  say("\n{} trials, {:.0f} minutes of session time, in {:.1f} s.\n"
      "The log:     {}\n"
      "Check it:    ./heft replay --db {} --session {}\n"
      "Try it:      ./heft run protocols/quick.toml --participant 01 --responder simulated\n\n",
      result.n_completed, result.duration_s / 60, elapsed.count(), request.db,
      shell_quoted(request.db), result.session_id);
  for (const std::string& sentence : leading_sentences(summary)) say("{}\n", sentence);
  say("The report:  {}/report.html\n", report);
}

}  // namespace

void add_demo(Command& app) {
  const auto options = std::make_shared<DemoOptions>();
  Command command = app.add_command(
      "demo", "the paper's whole session with a simulated participant, and what was found",
      {"heft demo", "heft demo --seed 42 --out trial-run"});
  command.add_option("--out", &options->out, "folder for the log and the report").shows_default();
  command.add_seed(options->seed, "always the same session; others may last twice as long");
  command.does([options] { demo(*options); });
}

}  // namespace heft::cli
