// The logs of an export, read row by row. Identifying data are replaced here if pseudonyms are
// requested. Private to record.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "record/export/ExportTables.h"

namespace heft {

/// A cell of an export.
struct ExportCell {
  enum class Kind { none, number, text } kind = Kind::none;
  std::string text;  ///< a number with all digits, or a text
};
using ExportCells = std::vector<ExportCell>;

class ExportSource {
 public:
  /// @param key of the pseudonyms; none: no pseudonyms
  /// @throws Error if a log cannot be read or is given twice
  ExportSource(const std::vector<std::string>& logs, std::optional<std::string> key);
  ~ExportSource();
  ExportSource(const ExportSource&) = delete;
  ExportSource& operator=(const ExportSource&) = delete;

  std::size_t n_logs() const;

  /// All tables, without the columns that pseudonyms exclude.
  const std::vector<ExportTable>& tables() const { return tables_; }
  const ExportTable& table(const std::string& name) const;
  /// A table without the columns that pseudonyms exclude.
  ExportTable shown(ExportTable table) const;

  std::int64_t count(const ExportTable& table) const;

  /// The column `log`, then the table's columns.
  std::vector<ExportColumn> columns(const ExportTable& table) const;

  /// Visits the rows of all logs in order, each starting with the cell `log`.
  void each_row(const ExportTable& table,
                const std::function<void(const ExportCells&)>& take) const;

  /// The same for one log. @param condition SQL after FROM, over r and s
  void each_row(const ExportTable& table, std::size_t log, const std::string& condition,
                const std::function<void(const ExportCells&)>& take) const;

 private:
  struct OpenLog;

  std::vector<OpenLog> logs_;
  std::optional<std::string> key_;
  std::vector<ExportTable> tables_;
};

/// Renumbers all rows of a copy of a log, for pseudonymised exports: persons in random order, and
/// each person's sessions in order of time. Ids and the order of rows then do not show who took
/// part when. Digests become invalid, and seals are removed.
void draw_fresh_ids(SQLite::Database& database);

}  // namespace heft
