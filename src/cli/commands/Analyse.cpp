// heft analyse: what a log holds, as tables, JSON, or a folder with charts and a report.
#include <fmt/format.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "analysis/dataset/Summary.h"
#include "analysis/report/Json.h"
#include "analysis/report/Report.h"
#include "analysis/report/Tables.h"
#include "base/files/Printable.h"
#include "cli/Commands.h"
#include "cli/console/Terminal.h"
#include "session/Session.h"

namespace heft::cli {

namespace {
struct AnalyseOptions {
  std::vector<std::string> databases;
  std::string out;
  std::vector<std::int64_t> sessions;
  bool json = false, mix = false;
};

// The command as it can be typed again.
std::string command_of(const AnalyseOptions& options) {
  std::string command = "heft analyse";
  for (const std::string& database : options.databases)
    command += " --db " + shell_quoted(database);
  for (std::int64_t id : options.sessions) command += fmt::format(" --session {}", id);
  if (options.mix) command += " --mix";
  if (!options.out.empty()) command += " --out " + shell_quoted(options.out);
  return command;
}

void report(const Summary& summary, const std::string& folder) {
  const ReportResult result = write_report(summary, folder);
  say("\n{} files in {}; open {}/report.html\n", result.files.size(), folder, folder);
  explain_missing_charts(result, folder);
}

void analyse(AnalyseOptions options) {
  if (options.databases.empty()) options.databases = {"heft.db"};
  for (const std::string& database : options.databases) refuse_special_file(database);
  if (!options.out.empty()) refuse_foreign_folder(options.out);
  const Summary summary =
      analyze({options.databases, options.sessions, options.mix, command_of(options)});
  if (options.json)
    fmt::print("{}", as_json(summary));
  else
    print("{}", readable(summary));
  flush_output();
  if (!options.out.empty())
    report(summary, options.out);
  else if (!options.json && !summary.sessions.empty())
    say("\nCharts and the report: {} --out DIR\n", command_of(options));
}
}  // namespace

void add_analyse(Command& app) {
  const auto options = std::make_shared<AnalyseOptions>();
  Command command = app.add_command(
      "analyse", "tables, estimates with intervals, charts and a report of logs",
      {"heft analyse --db heft.db", "heft analyse --db heft.db --out report",
       "heft analyse --db heft.db --session 3 4 --json", "heft analyse --db lab1.db --db lab2.db"});
  command.add_option(
      "--db", &options->databases,
      "the log (default: heft.db); of several, people named alike are different ones");
  command.add_option("--out", &options->out,
                     "a new or empty folder for CSV, charts, summary.json and report.html");
  command.add_sessions(options->sessions, "only these sessions (default: all)");
  command.add_flag("--json", options->json, "JSON on stdout instead of tables");
  command.add_flag("--mix", options->mix,
                   "put sessions of several purposes (main, pilot, test, simulated) together");
  command.does([options] { analyse(*options); });
}

}  // namespace heft::cli
