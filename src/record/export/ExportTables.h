// The tables of an export and their columns. Private to record.
#pragma once

#include <string>
#include <vector>

namespace SQLite {
class Database;
}

namespace heft {

/// What remains of a column if pseudonyms are requested.
enum class Privacy {
  open,       ///< everything
  person,     ///< the person's pseudonym
  kind,       ///< the part before the first ':', without file names
  number,     ///< numbers only
  year,       ///< the year of a time
  free_text,  ///< nothing: the column is excluded
};

/// A column and its entry in dictionary.csv.
struct ExportColumn {
  std::string name, unit, meaning;
  std::string levels;  ///< words of a closed list, "a|b|c"; empty: any value
  std::string sql;     ///< its value; r is the table's row, s its session
  Privacy privacy = Privacy::open;
};

/// The words of its closed list; empty: any value.
std::vector<std::string> levels_of(const ExportColumn& column);

struct ExportTable {
  std::string name;                   ///< "trials"
  std::string meaning;                ///< of a row
  std::string rows;                   ///< SQL after FROM, with the row r and its session s
  std::string order;                  ///< SQL after ORDER BY
  std::vector<ExportColumn> columns;  ///< without the first, `log`
};

/// Names of the answers and parameters of the participants of all logs.
struct ParticipantColumns {
  std::vector<std::string> infos, parameters;

  void add(SQLite::Database& database);
};

std::vector<ExportTable> export_tables(const ParticipantColumns& participants);

/// BIDS behavior: all attempts with their cubes.
ExportTable behavior_table();

/// BIDS events: those of trials, without texts.
ExportTable event_table();

/// A text as an SQL literal.
std::string sql_text(const std::string& text);

/// The first column of every file.
ExportColumn log_column();

}  // namespace heft
