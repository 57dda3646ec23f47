// What a study says before its data are there: which hypotheses it tests, and whom it will leave
// out. Part of the protocol's text, so of its hash.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace heft {

/// The hypotheses that can be declared.
inline constexpr std::array<std::string_view, 5> hypothesis_names{"E1-H1", "E1-H2", "E1-H3",
                                                                  "E2-H1", "E2-H2"};

/// [analysis]. What is not declared is printed as exploratory.
struct AnalysisPlan {
  std::array<bool, hypothesis_names.size()> tested{};
  double equivalence_margin = 10;  ///< points of percent around chance that count as chance

  bool declares(std::string_view hypothesis) const;
  bool declares_any() const;
};

/// [exclusion]. A participant beyond any of these is left out of every figure, and listed.
struct ExclusionRules {
  bool unfinished = false;                   ///< who has no finished session
  std::optional<double> anticipatory_responses;  ///< largest fraction of answers
  std::optional<double> false_alarms;        ///< largest fraction of catch trials
  std::optional<double> out_of_view;  ///< largest fraction of attempts with the effector lost

  bool any() const { return unfinished || anticipatory_responses || false_alarms || out_of_view; }
};

class TableReader;

/// Read and close the tables, where they are.
void read_analysis(TableReader& protocol, AnalysisPlan& plan);
void read_exclusion(TableReader& protocol, ExclusionRules& rules);

}  // namespace heft
