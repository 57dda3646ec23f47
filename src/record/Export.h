// Logs as CSV files for other programs: a file a table, and a data dictionary. Columns are the
// log's, from the rows' descriptions; what is said here is which tables there are and how a row
// finds its session.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace heft {

/// A file that was written, and its rows without the header.
struct ExportedFile {
  std::string name;
  std::int64_t n_rows = 0;
};

/// A column as dictionary.csv explains it.
struct ExportColumn {
  std::string name, unit, meaning;
  std::string levels;  ///< the words of a closed list, "a|b|c"; empty: any value
  std::string sql;     ///< what stands in it; r is the table's row, s its session
};

/// Writes trials.csv, answers.csv, reversals.csv, estimates.csv, cubes.csv, participants.csv,
/// setups.csv, frames.csv where frames were kept, and dictionary.csv, of all sessions of the logs
/// together; the column `log` says whose. RFC 4180 with LF, UTF-8, '.' decimals with all their
/// digits, an empty cell for NULL. Rows are in the order of the logs and of writing, so that equal
/// logs give equal files. A text that a spreadsheet would take for a formula (it begins with = + -
/// @ or a control character), or that begins with ', has a ' before it.
/// @param folder made if need be
/// @param progress called with the fraction of rows done, 0...1
/// @throws Error when a log can't be read or is given twice, or the folder holds something already
///   or can't be written
std::vector<ExportedFile> export_csv(const std::vector<std::string>& logs,
                                     const std::string& folder,
                                     const std::function<void(double)>& progress);

}  // namespace heft
