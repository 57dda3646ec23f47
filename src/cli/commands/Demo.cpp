// heft demo: the paper's session with a simulated participant, and its results.
#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <memory>

#include "analysis/Analysis.h"
#include "analysis/dataset/Summary.h"
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
  bool tables = false;
};

// The shortest session of 90 seeds; others take up to twice as long.
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
  say("Simulating the paper\'s session before a rendered camera, seed {}.\n", request.config->seed);
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
                           result.session_id, shell_quoted(report)),
               integrity_of({request.db}, {result.session_id}, false)});
  const ReportResult files = write_report(summary, report);
  const std::string log = "--db " + shell_quoted(request.db);
  FirstScreenOptions screen;
  screen.max_lines = 24;  // the line above is the first
  screen.done =
      fmt::format("{:.0f} min, simulated in {:.0f} s", result.duration_s / 60, elapsed.count());
  if (!files.charts_drawn) screen.attention.emplace_back(missing_charts);
  screen.next = {
      {"Report", report + "/report.html"},
      {"Tables", fmt::format("heft analyse {} --tables", log)},
      {"Verify", "heft replay " + log},
      {"Try it", "heft run protocols/quick.toml --participant 01 --responder simulated"}};
  print("{}", options.tables ? readable(summary) : first_screen(summary, screen));
  flush_output();
}

}  // namespace

void add_demo(Command& app) {
  const auto options = std::make_shared<DemoOptions>();
  Command command =
      app.add_command("demo", "the paper's session with a simulated participant, and its results",
                      {"heft demo", "heft demo --seed 42 --out trial-run"});
  command.add_option("--out", &options->out, "folder for the log and the report").shows_default();
  command.add_seed(options->seed, "a fixed one; others may last twice as long");
  command.add_flag("--tables", options->tables, "all tables instead of a summary");
  command.does([options] { demo(*options); });
}

}  // namespace heft::cli
