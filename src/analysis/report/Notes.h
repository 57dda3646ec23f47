// A summary in sentences: the results, what limits them, and the verdicts on the paper's
// hypotheses.
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/dataset/Summary.h"

namespace heft {

/// The results of all sections, a sentence each.
std::vector<std::string> findings_of(const Summary& summary);

/// The findings, and their limitations.
std::vector<std::string> leading_sentences(const Summary& summary);

/// Names the paper's hypotheses that were tested without a conclusion; empty: there are none.
std::string inconclusive_sentence(const Summary& summary);

/// Notes on the sessions, such as unfinished or repeated ones.
class NotesCollector {
 public:
  void add(const SessionData& data);
  /// A sentence each; none where nothing is out of the ordinary.
  /// @param summary of the same sessions
  std::vector<std::string> result(const Summary& summary) const;

 private:
  std::string repeated_note() const;
  std::string protocols_note() const;
  std::vector<std::string> methods_notes() const;
  std::string sorted_note() const;
  std::string dragged_note() const;
  std::string pictures_note() const;

  std::map<std::string, int> n_sessions_;         // by participant
  std::map<std::string, std::string> protocols_;  // names, by content
  /// Methods of the thresholds by block of judgments; "" for JNDs of comparisons.
  std::map<std::string, std::set<std::string>> methods_;
  std::map<std::string, std::set<std::vector<double>>> sorted_g_;  ///< masses, by condition
  std::vector<std::string> dragged_;
  PictureCounts pictures_;
};

/// E1-H1...E1-H3 (sorting) and E2-H1, E2-H2 (JND), stated as in the paper.
/// Each is declared or exploratory, as the summary's plan says.
std::vector<Hypothesis> hypotheses_of(const Summary& summary);

}  // namespace heft
