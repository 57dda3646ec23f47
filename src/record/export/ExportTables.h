// Which tables an export has, and the columns of each. Private to this room.
#pragma once

#include <string>
#include <vector>

namespace SQLite {
class Database;
}

namespace heft {

/// What of a column is left where people are to be told by pseudonyms.
enum class Privacy {
  open,       ///< all of it
  person,     ///< the person's pseudonym
  kind,       ///< what stands before the first ':', without a file's name
  number,     ///< what is a number
  year,       ///< of a time, its first four digits
  free_text,  ///< nothing: the column is left out
};

/// A column as dictionary.csv explains it.
struct ExportColumn {
  std::string name, unit, meaning;
  std::string levels;  ///< the words of a closed list, "a|b|c"; empty: any value
  std::string sql;     ///< what stands in it; r is the table's row, s its session
  Privacy privacy = Privacy::open;
};

/// The words of its closed list; none: any value.
std::vector<std::string> levels_of(const ExportColumn& column);

struct ExportTable {
  std::string name;                   ///< "trials"
  std::string meaning;                ///< what a row is
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

/// What BIDS calls behavior: all attempts, each with its cubes.
ExportTable behavior_table();

/// What BIDS calls events: those of trials, without their texts.
ExportTable event_table();

/// A text in SQL, whatever is in it.
std::string sql_text(const std::string& text);

/// The first column of every file.
ExportColumn log_column();

}  // namespace heft
