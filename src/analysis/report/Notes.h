// What a summary says in sentences: what a reader must know about what was counted and what was
// not, and the figures that speak to the paper's hypotheses.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "analysis/dataset/Summary.h"

namespace heft {

/// The results of each task in a sentence, and what limits them.
std::vector<std::string> leading_sentences(const Summary& summary);

/// "13 simulated participants"
std::string participants_in_words(const Summary& summary);

/// The verdicts on the paper's hypotheses about sorting, of those of its conditions that were run:
/// "; masses are discriminated in soft".
std::string verdicts_in_words(const Summary& summary);

/// What notes tell of the sessions beside the figures.
class NotesFold {
 public:
  void add(const SessionData& data);
  /// A sentence each; none where nothing is out of the ordinary.
  /// @param summary of the same sessions
  std::vector<std::string> result(const Summary& summary) const;

 private:
  std::string repeated_note() const;
  std::string protocols_note() const;
  std::string other_methods_note() const;
  std::string dragged_note() const;
  std::string pictures_note() const;

  std::map<std::string, int> n_sessions_;         // by participant
  std::map<std::string, std::string> protocols_;  // names, by content
  std::set<std::string> methods_;
  std::vector<std::string> dragged_;
  PictureCounts pictures_;
};

/// Points of percent beside chance that count as chance: the protocol's, or 10.
double equivalence_margin_percent(const Summary& summary);

/// E1-H1...E1-H3 (sorting) and E2-H1, E2-H2 (JND), stated as in the paper.
/// Each is declared or exploratory, as the summary's plan says.
std::vector<Hypothesis> hypotheses_of(const Summary& summary);

}  // namespace heft
