// Which files an export has, and the columns of each. Private to this room.
#pragma once

#include <string>
#include <vector>

#include "record/Export.h"

namespace SQLite {
class Database;
}

namespace heft {

struct ExportTable {
  std::string file;                   ///< "trials.csv"
  std::string rows;                   ///< SQL: FROM ... that names the row r and its session s
  std::string order;                  ///< by which columns
  std::vector<ExportColumn> columns;  ///< but for the first, `log`
};

/// What the participants of all logs were asked and drawn as: a column each, by name.
struct ParticipantColumns {
  std::vector<std::string> infos, parameters;

  void add(SQLite::Database& database);
};

std::vector<ExportTable> export_tables(const ParticipantColumns& participants);

/// The first column of every file.
ExportColumn log_column();

}  // namespace heft
