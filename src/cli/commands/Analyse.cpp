// heft analyse: estimates from logs, as one screen, tables, JSON, or a folder with a report.
#include <fmt/format.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "analysis/Analysis.h"
#include "analysis/dataset/Summary.h"
#include "analysis/report/Report.h"
#include "analysis/report/Tables.h"
#include "base/files/Printable.h"
#include "cli/Commands.h"
#include "cli/SessionOptions.h"
#include "cli/console/Terminal.h"
#include "session/Session.h"

namespace heft::cli {

namespace {
struct AnalyseOptions {
  std::vector<std::string> databases;
  std::string out;
  std::vector<std::int64_t> sessions;
  bool json = false, mix = false, tables = false, unverified = false;
};

// The command, for repeating it with other options.
std::string command_of(const AnalyseOptions& options) {
  std::string command = "heft analyse";
  for (const std::string& database : options.databases)
    command += " --db " + shell_quoted(database);
  for (std::int64_t id : options.sessions) command += fmt::format(" --session {}", id);
  if (options.mix) command += " --mix";
  if (options.unverified) command += " --unverified";
  if (!options.out.empty()) command += " --out " + shell_quoted(options.out);
  return command;
}

// The first screen; the report is already written if there is one.
std::string screen_of(const Summary& summary, const AnalyseOptions& options,
                      const std::optional<ReportResult>& report) {
  AnalyseOptions without_report = options;
  without_report.out.clear();
  const std::string command = command_of(without_report);
  FirstScreenOptions screen;
  if (report)
    screen.next.push_back({"Report", fmt::format("{}/report.html ({} files in its folder)",
                                                 options.out, report->files.size())});
  if (report && !report->charts_drawn) screen.attention.emplace_back(missing_charts);
  if (!report && !summary.sessions.empty())
    screen.next.push_back({"Charts and report", command + " --out report"});
  if (!summary.sessions.empty()) screen.next.push_back({"All tables", command + " --tables"});
  return first_screen(summary, screen);
}

void analyse(AnalyseOptions options) {
  if (options.databases.empty()) options.databases = {usual_log};
  for (const std::string& database : options.databases) refuse_special_file(database);
  if (!options.out.empty()) refuse_foreign_folder(options.out);
  const Summary summary =
      analyze({options.databases, options.sessions, options.mix, command_of(options),
               integrity_of(options.databases, options.sessions, options.unverified)});
  std::optional<ReportResult> report;
  if (!options.out.empty()) report = write_report(summary, options.out);
  if (options.json)
    fmt::print("{}", as_json(summary));
  else
    print("{}", options.tables ? readable(summary) : screen_of(summary, options, report));
  flush_output();
  if (report && (options.json || options.tables)) explain_missing_charts(*report, options.out);
}
}  // namespace

void add_analyse(Command& app) {
  const auto options = std::make_shared<AnalyseOptions>();
  Command command = app.add_command(
      "analyse", "results of logs with intervals, as text, tables, charts, a report",
      {"heft analyse --db heft.db", "heft analyse --db heft.db --out report",
       "heft analyse --db heft.db --session 3 4 --json", "heft analyse --db lab1.db --db lab2.db"});
  command.add_option(
      "--db", &options->databases,
      "the log (default: heft.db); repeat for several, whose participants are kept distinct");
  command.add_option("--out", &options->out,
                     "a new or empty folder for CSV, charts, summary.json and report.html");
  command.add_sessions(options->sessions, "only these sessions (default: all)");
  command.add_flag("--json", options->json, "all results as JSON on stdout");
  command.add_flag("--tables", options->tables, "all tables instead of a summary");
  command.add_flag("--mix", options->mix,
                   "combine sessions of several purposes (main, pilot, test, simulated)");
  add_unverified(command, options->unverified);
  command.does([options] { analyse(*options); });
}

}  // namespace heft::cli
