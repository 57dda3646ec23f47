// The logs of an export, read row by row: never more than one row is in memory. What tells who
// somebody is leaves this room by its pseudonym, where there are any. Private to this room.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "record/export/ExportTables.h"

namespace heft {

/// A cell as an export has it: what it says, and whether it is a text.
struct ExportCell {
  enum class Kind { none, number, text } kind = Kind::none;
  std::string text;  ///< a number with all its digits; a text as it is
};
using ExportCells = std::vector<ExportCell>;

class ExportSource {
 public:
  /// @param key of the pseudonyms; none: names stay
  /// @throws Error when a log can't be read or is given twice
  ExportSource(const std::vector<std::string>& logs, std::optional<std::string> key);
  ~ExportSource();
  ExportSource(const ExportSource&) = delete;
  ExportSource& operator=(const ExportSource&) = delete;

  std::size_t n_logs() const;

  /// All tables, without what pseudonyms leave out.
  const std::vector<ExportTable>& tables() const { return tables_; }
  const ExportTable& table(const std::string& name) const;
  /// A table without what pseudonyms leave out.
  ExportTable shown(ExportTable table) const;

  std::int64_t count(const ExportTable& table) const;

  /// `log` and the table's columns.
  std::vector<ExportColumn> columns(const ExportTable& table) const;

  /// The rows of all logs in order, each with its cell of `log` in front.
  void each_row(const ExportTable& table,
                const std::function<void(const ExportCells&)>& take) const;

  /// The same of one log, where a condition in SQL over r and s holds.
  void each_row(const ExportTable& table, std::size_t log, const std::string& condition,
                const std::function<void(const ExportCells&)>& take) const;

 private:
  struct OpenLog;

  std::vector<OpenLog> logs_;
  std::optional<std::string> key_;
  std::vector<ExportTable> tables_;
};

}  // namespace heft
