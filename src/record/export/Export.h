// Exports of logs for other programs: CSV tables, or datasets of the standards Psych-DS or BIDS.
// Columns are those of the log. Pseudonyms replace participants on request.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/Names.h"

namespace heft {

enum class ExportFormat { csv, psych_ds, bids };
template <>
struct EnumNames<ExportFormat> {
  static constexpr std::array<std::string_view, 3> names{"csv", "psych-ds", "bids"};
};

/// A written file and, if it is a table, its number of rows without the header.
struct ExportedFile {
  std::string name;
  std::optional<std::int64_t> n_rows;
};

/// A person's name that is unique across logs.
inline std::string person_name(const std::string& log, const std::string& participant) {
  return log + ": " + participant;
}

/// The lab that each log is from: the log's file name without folder and extension, or the log as
/// given where another has that name too.
std::vector<std::string> lab_names(const std::vector<std::string>& logs);

struct ExportRequest {
  std::vector<std::string> logs;
  ExportFormat format = ExportFormat::csv;
  std::string folder;                   ///< new or empty; created if missing
  std::optional<std::string> key = {};  ///< of the pseudonyms; none: no pseudonyms
  bool is_verified = true;              ///< false: every table has a column `unverified`
};

/// Exports all sessions of the logs; the column `log` names the log, `lab` its lab. `person` is the
/// participant, for several logs person_name().
/// - csv: trials.csv, wide.csv, choices.csv, answers.csv, reversals.csv, estimates.csv, cubes.csv,
///   participants.csv, setups.csv, frames.csv if there are frames, dictionary.csv, analysis.R.
/// - psych-ds: the same as data/description-..._data.csv, with dataset_description.json.
/// - bids: participants.tsv, and for each session and task a table of trials and one of events.
/// CSV is RFC 4180 with LF, UTF-8, '.' decimals with all digits, and empty cells for NULL. Rows are
/// in the order of logs and writing, so that equal logs give equal files. A ' is added before a
/// text that a spreadsheet would read as a formula (starting with = + - @ or a control character)
/// or that starts with '. During the export the folder holds export_unfinished.txt.
/// @param progress called with the fraction of rows done, 0...1
/// @throws Error if a log cannot be read or is given twice, or the folder is not empty or cannot be
///   written
std::vector<ExportedFile> export_logs(const ExportRequest& request,
                                      const std::function<void(double)>& progress);

/// The unit of each column of the exports and the log, as in dictionary.csv; without those that
/// have none.
std::map<std::string, std::string> units_of_columns();

/// @throws Error (usage) if the folder is not empty or no folder
void refuse_filled_folder(const std::string& folder);

/// HMAC-SHA-256 (RFC 2104), 64 lowercase hexadecimal digits.
std::string hmac_sha256(std::string_view key, std::string_view text);

/// "p" and 12 hexadecimal digits of the HMAC. Among 10,000 people the probability of a collision is
/// 1 in 5 million.
std::string pseudonym(std::string_view key, std::string_view person);

struct PseudonymKey {
  std::string file, key;
  bool is_new = false;
};

/// Reads the key from a file; creates the file with a key of 256 random bits, readable by its owner
/// only, if it is missing.
/// @throws Error if the file cannot be read or created, is no line of 64 lowercase hexadecimal
///   digits, or its digits are not random
PseudonymKey pseudonym_key(const std::string& file);

}  // namespace heft
