// The summary that a command prints by default: one terminal screen of plain sentences. The tables
// are in Tables.h.
#pragma once

#include <string>
#include <vector>

#include "analysis/dataset/Summary.h"

namespace heft {

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

}  // namespace heft
