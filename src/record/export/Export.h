// Logs as files for other programs: CSV as this program writes it, or a dataset that follows the
// standards Psych-DS or BIDS. Columns are the log's, from the rows' descriptions; what is said here
// is which files there are and how a row finds its session.
// Names that stand for people's: the same person has the same one in every export with the same
// key, and without the key nobody can tell whether a name belongs to it.
#pragma once

#include <cstdint>
#include <functional>
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

/// A file that was written, and its rows without the header; none: it has no rows.
struct ExportedFile {
  std::string name;
  std::optional<std::int64_t> n_rows;
};

/// Who is one person where several logs are read together: people named alike in two labs' logs are
/// two. @param log its name
inline std::string person_name(const std::string& log, const std::string& participant) {
  return log + ": " + participant;
}

struct ExportRequest {
  std::vector<std::string> logs;
  ExportFormat format = ExportFormat::csv;
  std::string folder;                   ///< new or empty; made if need be
  std::optional<std::string> key = {};  ///< of the pseudonyms; none: names stay
};

/// All sessions of the logs together; the column `log` says whose. `person` is the participant; of
/// several logs person_name().
/// - csv: trials.csv, wide.csv, choices.csv, answers.csv, reversals.csv, estimates.csv, cubes.csv,
///   participants.csv, setups.csv, frames.csv where frames were kept, dictionary.csv, analysis.R.
/// - psych-ds: the same as data/description-..._data.csv, with dataset_description.json.
/// - bids: participants.tsv and, a session and task, a table of its trials and one of its events.
/// CSV is RFC 4180 with LF, UTF-8, '.' decimals with all their digits, an empty cell for NULL. Rows
/// are in the order of the logs and of writing, so that equal logs give equal files. A text that a
/// spreadsheet would take for a formula (it begins with = + - @ or a control character), or that
/// begins with ', has a ' before it. While it is written the folder holds export_unfinished.txt.
/// @param progress called with the fraction of rows done, 0...1
/// @throws Error when a log can't be read or is given twice, or the folder holds something already
///   or can't be written
std::vector<ExportedFile> export_logs(const ExportRequest& request,
                                      const std::function<void(double)>& progress);

/// @throws Error (usage) when something is in the folder already, or it is no folder
void refuse_filled_folder(const std::string& folder);

/// HMAC-SHA-256 (RFC 2104), 64 lowercase hexadecimal digits.
std::string hmac_sha256(std::string_view key, std::string_view text);

/// "p" and 12 hexadecimal digits: of 10,000 people two are alike once in 5 million times.
std::string pseudonym(std::string_view key, std::string_view person);

struct PseudonymKey {
  std::string file, key;
  bool is_new = false;
};

/// The key that is in a file; if there is no such file, a new one of 256 random bits in a file that
/// only its owner can read.
/// @throws Error when the file can't be read or made, or is no line of 64 lowercase hexadecimal
///   digits, or one of digits that nobody drew
PseudonymKey pseudonym_key(const std::string& file);

}  // namespace heft
