#include "record/export/ExportSource.h"

#include <SQLiteCpp/Backup.h>
#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>
#include <sqlite3.h>

#include <algorithm>
#include <set>

#include "base/Error.h"
#include "base/files/TextFile.h"
#include "record/export/Export.h"
#include "record/file/Failures.h"
#include "record/file/LogFile.h"

namespace heft {

struct ExportSource::OpenLog {
  std::string name, lab;
  std::unique_ptr<SQLite::Database> database;
};

namespace {
using Kind = ExportCell::Kind;

ExportCell cell_of(const SQLite::Column& cell) {
  switch (cell.getType()) {
    case SQLITE_INTEGER:
      return {Kind::number, fmt::format("{}", cell.getInt64())};
    case SQLITE_FLOAT:
      return {Kind::number, fmt::format("{}", cell.getDouble())};
    case SQLITE_NULL:
      return {};
    default:
      return {Kind::text, cell.getString()};
  }
}

// "simulated:MODEL.toml" becomes "simulated".
std::string kind_of(const std::string& text) {
  const std::string kind = text.substr(0, text.find(':'));
  return kind.find('/') == std::string::npos ? kind : "file";
}

void make_private(ExportCell& cell, Privacy privacy, const std::string& key) {
  if (cell.kind != Kind::text) return;
  if (privacy == Privacy::person) cell.text = pseudonym(key, cell.text);
  if (privacy == Privacy::kind) cell.text = kind_of(cell.text);
  if (privacy == Privacy::year) cell.text.resize(std::min<std::size_t>(cell.text.size(), 4));
  if (privacy == Privacy::number && !number_in(cell.text)) cell = {};
}

std::unique_ptr<SQLite::Database> renumbered_copy(SQLite::Database& log) {
  // A temporary file without a name.
  auto copy = std::make_unique<SQLite::Database>("", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
  SQLite::Backup(*copy, log).executeStep();
  distrust(*copy);
  draw_fresh_ids(*copy);
  return copy;
}
}  // namespace

ExportSource::ExportSource(const std::vector<std::string>& logs, std::optional<std::string> key)
    : key_(std::move(key)) {
  std::set<std::string> files;
  ParticipantColumns participants;
  for (const std::string& name : logs) {
    if (!files.insert(resolved_path(name)).second)
      throw Error(fmt::format("{} is given twice", name), ExitCode::usage);
    OpenLog log{name, "", open_for_reading(name)};
    if (!holds_log(*log.database, name)) continue;
    if (key_) log.database = renumbered_copy(*log.database);
    log.database->exec("BEGIN");  // all reads see one snapshot
    participants.add(*log.database);
    if (key_) log.name = fmt::format("log{}", logs_.size() + 1);
    logs_.push_back(std::move(log));
  }
  std::vector<std::string> names;
  for (const OpenLog& log : logs_) names.push_back(log.name);
  const std::vector<std::string> labs = lab_names(names);
  for (std::size_t i = 0; i < logs_.size(); ++i) logs_[i].lab = labs[i];
  for (ExportTable& table : export_tables(participants)) tables_.push_back(shown(std::move(table)));
}

ExportSource::~ExportSource() = default;

std::size_t ExportSource::n_logs() const {
  return logs_.size();
}

const ExportTable& ExportSource::table(const std::string& name) const {
  const auto found = std::ranges::find(tables_, name, &ExportTable::name);
  if (found == tables_.end()) throw std::logic_error("no table " + name);
  return *found;
}

ExportTable ExportSource::shown(ExportTable table) const {
  if (key_)
    std::erase_if(table.columns,
                  [](const ExportColumn& column) { return column.privacy == Privacy::free_text; });
  return table;
}

std::int64_t ExportSource::count(const ExportTable& table) const {
  std::int64_t n = 0;
  for (const OpenLog& log : logs_)
    n += log.database->execAndGet("SELECT count(*) FROM " + table.rows).getInt64();
  return n;
}

std::vector<ExportColumn> ExportSource::columns(const ExportTable& table) const {
  std::vector<ExportColumn> columns{log_column()};
  columns.insert(columns.end(), table.columns.begin(), table.columns.end());
  return columns;
}

void ExportSource::each_row(const ExportTable& table,
                            const std::function<void(const ExportCells&)>& take) const {
  for (std::size_t i = 0; i < logs_.size(); ++i) each_row(table, i, "", take);
}

void ExportSource::each_row(const ExportTable& table, std::size_t log, const std::string& condition,
                            const std::function<void(const ExportCells&)>& take) const try {
  std::string columns;
  for (const ExportColumn& column : table.columns)
    columns += (columns.empty() ? "" : ", ") + column.sql;
  SQLite::Statement query(
      *logs_[log].database,
      fmt::format("SELECT {} FROM {}{} ORDER BY {}", columns, table.rows, condition, table.order));
  ExportCells cells(table.columns.size() + 1, {Kind::text, logs_[log].name});
  while (query.executeStep()) {
    for (std::size_t i = 1; i < cells.size(); ++i) {
      cells[i] = cell_of(query.getColumn(static_cast<int>(i) - 1));
      const ExportColumn& column = table.columns[i - 1];
      if (key_) make_private(cells[i], column.privacy, *key_);
      if (column.name == "person" && n_logs() > 1)
        cells[i].text = person_name(logs_[log].name, cells[i].text);
      if (column.name == "lab") cells[i].text = logs_[log].lab;
    }
    take(cells);
  }
} catch (const SQLite::Exception& error) {
  throw sqlite_error(fmt::format("cannot read {} for {}", logs_[log].name, table.name), error,
                     logs_[log].database.get());
}

}  // namespace heft
