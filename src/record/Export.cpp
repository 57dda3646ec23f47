#include "record/Export.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>
#include <sqlite3.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <set>

#include "base/Csv.h"
#include "base/Error.h"
#include "record/ExportTables.h"
#include "record/Failures.h"
#include "record/LogFile.h"
#include "record/ReadOnlyDatabase.h"

namespace heft {

namespace {
namespace fs = std::filesystem;

struct OpenLog {
  std::string name;
  std::unique_ptr<SQLite::Database> database;
};

std::vector<OpenLog> opened(const std::vector<std::string>& names) {
  std::vector<OpenLog> logs;
  std::set<std::string> files;
  for (const std::string& name : names) {
    if (!files.insert(resolved_path(name)).second)
      throw Error(fmt::format("{} is given twice", name), ExitCode::usage);
    OpenLog log{name, open_for_reading(name)};
    if (!holds_log(*log.database, name)) continue;
    log.database->exec("BEGIN");  // one moment for all of its rows
    logs.push_back(std::move(log));
  }
  return logs;
}

class CsvFile {
 public:
  explicit CsvFile(const fs::path& path) : path_(path), file_(path, std::ios::binary) {}

  void line(const std::vector<std::string>& cells) {
    for (std::size_t i = 0; i < cells.size(); ++i) file_ << (i > 0 ? "," : "") << cells[i];
    file_ << '\n';
  }
  void close() {
    file_.close();
    if (!file_)
      throw Error(
          fmt::format("can't write {}: {}. The logs are untouched; export again to another "
                      "folder.",
                      path_.string(), std::strerror(errno)));
  }

 private:
  fs::path path_;
  std::ofstream file_;
};

std::string text_cell(const std::string& text) {
  return csv_cell(without_formula(text));
}

std::string cell_of(const SQLite::Column& cell) {
  switch (cell.getType()) {
    case SQLITE_INTEGER:
      return fmt::format("{}", cell.getInt64());
    case SQLITE_FLOAT:
      return fmt::format("{}", cell.getDouble());
    case SQLITE_NULL:
      return "";
    default:
      return text_cell(cell.getString());
  }
}

class Exporter {
 public:
  Exporter(std::vector<OpenLog> logs, const fs::path& folder,
           const std::function<void(double)>& progress)
      : logs_(std::move(logs)), folder_(folder), progress_(progress) {
    ParticipantColumns participants;
    for (const OpenLog& log : logs_) participants.add(*log.database);
    tables_ = export_tables(participants);
    std::erase_if(tables_, [this](const ExportTable& table) {
      const std::int64_t n = count(table);
      n_all_ += n;
      return n == 0 && table.file == "frames.csv";
    });
  }

  std::vector<ExportedFile> run() {
    CsvFile dictionary(folder_ / "dictionary.csv");
    dictionary.line({"file", "column", "unit", "meaning", "levels"});
    std::int64_t n_explained = 0;
    for (const ExportTable& table : tables_) {
      write(table);
      for (const ExportColumn& column : all_columns(table)) {
        dictionary.line({table.file, text_cell(column.name), csv_cell(column.unit),
                         csv_cell(column.meaning), csv_cell(column.levels)});
        ++n_explained;
      }
    }
    dictionary.close();
    files_.push_back({"dictionary.csv", n_explained});
    return files_;
  }

 private:
  std::int64_t count(const ExportTable& table) const {
    std::int64_t n = 0;
    for (const OpenLog& log : logs_)
      n += log.database->execAndGet("SELECT count(*) FROM " + table.rows).getInt64();
    return n;
  }

  static std::vector<ExportColumn> all_columns(const ExportTable& table) {
    std::vector<ExportColumn> columns{log_column()};
    columns.insert(columns.end(), table.columns.begin(), table.columns.end());
    return columns;
  }

  void write(const ExportTable& table) {
    CsvFile file(folder_ / table.file);
    std::vector<std::string> names;
    for (const ExportColumn& column : all_columns(table)) names.push_back(text_cell(column.name));
    file.line(names);
    const std::int64_t n_before = n_done_;
    for (const OpenLog& log : logs_) write_rows(table, log, file);
    file.close();
    files_.push_back({table.file, n_done_ - n_before});
  }

  void write_rows(const ExportTable& table, const OpenLog& log, CsvFile& file) try {
    std::string columns;
    for (const ExportColumn& column : table.columns)
      columns += (columns.empty() ? "" : ", ") + column.sql;
    SQLite::Statement query(*log.database, fmt::format("SELECT {} FROM {} ORDER BY {}", columns,
                                                       table.rows, table.order));
    std::vector<std::string> cells(table.columns.size() + 1, text_cell(log.name));
    while (query.executeStep()) {
      for (std::size_t i = 1; i < cells.size(); ++i)
        cells[i] = cell_of(query.getColumn(static_cast<int>(i) - 1));
      file.line(cells);
      tell_progress();
    }
  } catch (const SQLite::Exception& error) {
    const SqliteFailure failure = explained(error, log.database.get());
    throw Error(fmt::format("can't read {} for {}: {}. {}.", log.name, table.file, failure.reason,
                            failure.advice));
  }

  void tell_progress() {
    constexpr std::int64_t now_and_then = 1000;
    if (++n_done_ % now_and_then == 0)
      progress_(static_cast<double>(n_done_) / static_cast<double>(n_all_));
  }

  std::vector<OpenLog> logs_;
  fs::path folder_;
  const std::function<void(double)>& progress_;
  std::vector<ExportTable> tables_;
  std::vector<ExportedFile> files_;
  std::int64_t n_all_ = 0, n_done_ = 0;
};

void refuse_filled_folder(const std::string& folder) {
  std::error_code unknown;  // what can't be looked at is explained when it is written to
  if (!fs::exists(folder, unknown)) return;
  if (!fs::is_directory(folder, unknown))
    throw Error(fmt::format("--out {}: it is a file, expected a folder", folder), ExitCode::usage);
  if (!fs::is_empty(folder, unknown))
    throw Error(fmt::format("--out {}: the folder holds files already, and nothing is overwritten. "
                            "Name a new or empty folder.",
                            folder),
                ExitCode::usage);
}
}  // namespace

std::vector<ExportedFile> export_csv(const std::vector<std::string>& logs,
                                     const std::string& folder,
                                     const std::function<void(double)>& progress) {
  refuse_filled_folder(folder);
  std::vector<OpenLog> open = opened(logs);
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw Error(fmt::format("can't make the folder {}: {}", folder, error.message()));
  return Exporter(std::move(open), folder, progress).run();
}

}  // namespace heft
