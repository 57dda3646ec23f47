// Everything that an analysis prints or writes: the report folder, summary.json and the first
// screen.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/dataset/Summary.h"
#include "inference/AnswerData.h"

namespace heft {

struct ReportResult {
  std::vector<std::string> files;  ///< written, by name
  bool charts_drawn = true;        ///< false: gnuplot is not installed
};

/// Writes into `folder`, which is made if need be. A folder that an earlier analysis made is
/// replaced. Meanwhile the folder holds report_unfinished.txt.
/// @throws Error when the folder holds anything else or an unfinished report, or can't be written
ReportResult write_report(const Summary& summary, const std::string& folder);

/// Whether write_report would refuse the folder; for asking before a long analysis.
/// @throws Error as write_report
void refuse_foreign_folder(const std::string& folder);

/// A command or file for the reader's next step.
struct NextStep {
  std::string label;  ///< "All tables"
  std::string what;   ///< "heft analyse --db heft.db --tables"
};

struct FirstScreenOptions {
  std::string done{};                    ///< added to the line that counts the trials
  std::vector<std::string> attention{};  ///< sentences beside those of the summary
  std::vector<NextStep> next{};
  std::size_t max_lines = 25;
};

/// What was done, the results with intervals, what deserves attention, and the next steps: at most
/// `max_lines` lines of 80 columns, however many conditions and participants there are. Only a
/// single word (a path) that is longer makes a line longer.
std::string first_screen(const Summary& summary, const FirstScreenOptions& options);

/// Sentences on everything that limits the results: excluded participants, void attempts, lost
/// tracking, anticipatory responses, censored staircases, thresholds that are not identifiable.
std::vector<std::string> attention_sentences(const Summary& summary);

/// UTF-8, indented by two spaces, ending in a newline. Percentages are 0...100.
std::string as_json(const Summary& summary);

/// A table for each group, and the reason where there is no threshold; of a mixed fit also a table
/// of each person's threshold.
std::string fits_as_text(std::span<const NamedFit> fits);

/// A list of objects: group, parameters (value, se, low, high, fixed; null for what does not
/// exist), log_likelihood, n_trials, identifiable, why (null where identifiable); indecision has
/// threshold_75_g beside the parameters too. Of a mixed fit also people, an object by name: value,
/// low, high, identifiable, why.
std::string fits_as_json(std::span<const NamedFit> fits);

}  // namespace heft
