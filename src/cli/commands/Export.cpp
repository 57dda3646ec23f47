// heft export: logs as files for other programs.
#include "record/export/Export.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/Error.h"
#include "base/files/Printable.h"
#include "cli/Commands.h"
#include "cli/SessionOptions.h"
#include "cli/console/Terminal.h"
#include "session/Session.h"

namespace heft::cli {

namespace {
struct ExportOptions {
  std::vector<std::string> logs, databases;
  std::string format = "csv", out, key_file;
  bool pseudonymise = false, unverified = false;
};

// Beside the folder, not in it, because the folder is shared.
std::string key_file_of(const ExportOptions& options) {
  namespace fs = std::filesystem;
  std::string folder = options.out;
  while (folder.size() > 1 && folder.ends_with('/')) folder.pop_back();
  const std::string file = options.key_file.empty() ? folder + ".key" : options.key_file;
  const fs::path given_away = fs::weakly_canonical(fs::absolute(folder)),
                 key = fs::weakly_canonical(fs::absolute(file));
  if (std::ranges::mismatch(given_away, key).in1 == given_away.end())
    throw Error(fmt::format("--key {}: it would be shared with the folder {}. Name a place "
                            "outside of it",
                            file, options.out),
                ExitCode::usage);
  if (options.key_file.empty()) fs::create_directories(key.parent_path());
  return file;
}

std::optional<std::string> key_of(const ExportOptions& options) {
  if (!options.pseudonymise && options.key_file.empty()) return std::nullopt;
  const PseudonymKey key = pseudonym_key(key_file_of(options));
  say("{} {}: it links pseudonyms to persons. Keep it private.\n",
      key.is_new ? "made the key" : "used the key", key.file);
  return key.key;
}

void list_files(const std::vector<ExportedFile>& files) {
  constexpr std::size_t most_listed = 20;
  for (std::size_t i = 0; i < std::min(files.size(), most_listed); ++i)
    say("{:>10} {}  {}\n", files[i].n_rows ? std::to_string(*files[i].n_rows) : "",
        files[i].n_rows ? "rows" : "    ", files[i].name);
  if (files.size() > most_listed) say("           and {} more files\n", files.size() - most_listed);
}

void export_to(const ExportOptions& options) {
  std::vector<std::string> logs = options.logs;
  logs.insert(logs.end(), options.databases.begin(), options.databases.end());
  if (logs.empty()) logs.emplace_back(usual_log);
  for (const std::string& log : logs) refuse_special_file(log);
  refuse_filled_folder(options.out);
  const LogIntegrity integrity = integrity_of(logs, {}, options.unverified);
  const ExportFormat format = *named<ExportFormat>(options.format);
  const ExportRequest request{logs, format, options.out, key_of(options), integrity.is_verified};
  std::vector<ExportedFile> files;
  {
    ProgressBar bar("exporting");
    files = export_logs(request, [&](double fraction) { bar.update(fraction, ""); });
  }
  list_files(files);
  say("the log: {}\n", integrity.words);
  if (format == ExportFormat::csv)
    say("\ndictionary.csv explains every column. In R: trials <- read.csv(\"{0}/trials.csv\"); "
        "figures and models: (cd {1} && Rscript analysis.R)\n",
        options.out, shell_quoted(options.out));
}
}  // namespace

void add_export(Command& app) {
  const auto options = std::make_shared<ExportOptions>();
  Command command = app.add_command(
      "export", "tables for other programs, with a data dictionary",
      {"heft export --db heft.db --format csv --out data",
       "heft export lab1.db lab2.db --format psych-ds --out dataset",
       "heft export heft.db --format bids --pseudonymise --out shared", "",
       "--pseudonymise replaces participants' ids by names such as p1a2b3c4d5e6f (HMAC-SHA-256 "
       "with the key, so that a person has the same name in each export with it). It omits seeds, "
       "typed texts and file names, keeps only numbers of what participants reported, and only the "
       "year of dates. Sessions and all rows get fresh ids in a random order of persons. Answers "
       "and times remain: anyone with an export with names can match them.",
       "",
       "The key is a line of 64 hexadecimal digits, created if its file is missing. To make your "
       "own:",
       "(umask 077; openssl rand -hex 32 > study.key)"});
  command.add_option("LOG", &options->logs, "logs, together in one folder (default: heft.db)");
  command.add_option("--db", &options->databases, "the same");
  command
      .add_option(
          "--format", &options->format,
          "csv: one file per table, and analysis.R; psych-ds, bids: a dataset by that standard")
      .shows_default()
      .one_of({"csv", "psych-ds", "bids"});
  command.add_option("--out", &options->out, "a new or empty folder").required();
  command.add_flag("--pseudonymise", options->pseudonymise,
                   "no names and no typed texts; the key is OUT.key, created if it is missing");
  command.add_option("--key", &options->key_file,
                     "another file for --pseudonymise: its key, or a new one if it is missing");
  add_unverified(command, options->unverified);
  command.does([options] { export_to(*options); });
}

}  // namespace heft::cli
