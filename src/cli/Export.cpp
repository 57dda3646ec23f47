// heft export: logs as files for other programs.
#include "record/Export.h"

#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include "base/Printable.h"
#include "cli/Commands.h"
#include "cli/Terminal.h"
#include "session/Session.h"

namespace heft::cli {

namespace {
struct Options {
  std::vector<std::string> logs, databases;
  std::string format = "csv", out;
};

void export_logs(const Options& options) {
  std::vector<std::string> logs = options.logs;
  logs.insert(logs.end(), options.databases.begin(), options.databases.end());
  if (logs.empty()) logs.emplace_back("heft.db");
  for (const std::string& log : logs) refuse_special_file(log);
  std::vector<ExportedFile> files;
  {
    ProgressBar bar("exporting");
    files = export_csv(logs, options.out, [&](double fraction) { bar.update(fraction, ""); });
  }
  for (const ExportedFile& file : files) say("{:>10} rows  {}\n", file.n_rows, file.name);
  say("\ndictionary.csv explains every column. In R: trials <- read.csv(\"{}/trials.csv\")\n",
      options.out);
}
}  // namespace

void add_export(Command& app) {
  const auto options = std::make_shared<Options>();
  Command command = app.add_command(
      "export", "logs as CSV files for other programs, with a data dictionary",
      {"heft export heft.db --format csv --out data", "heft export lab1.db lab2.db --out data"});
  command.add_option("LOG", &options->logs, "logs, together in one folder (default: heft.db)");
  command.add_option("--db", &options->databases, "the same");
  command.add_option("--format", &options->format, "csv: a file a table")
      .shows_default()
      .one_of({"csv"});
  command.add_option("--out", &options->out, "a new or empty folder").required();
  command.does([options] { export_logs(*options); });
}

}  // namespace heft::cli
