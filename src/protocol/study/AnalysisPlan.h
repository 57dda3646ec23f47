// A study's hypotheses and exclusion rules, declared before its data exist. Part of the protocol's
// text and thus of its hash.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace heft {

/// Names of the hypotheses that can be declared.
inline constexpr std::array<std::string_view, 5> hypothesis_names{"E1-H1", "E1-H2", "E1-H3",
                                                                  "E2-H1", "E2-H2"};

/// [analysis]. Other results are reported as exploratory.
struct AnalysisPlan {
  std::array<bool, hypothesis_names.size()> tested{};
  double equivalence_margin = 10;  ///< percentage points around chance

  bool declares(std::string_view hypothesis) const;
  bool declares_any() const;
};

/// [exclusion]. A participant beyond any of these is excluded from every result, and listed.
struct ExclusionRules {
  bool unfinished = false;                       ///< participants without a finished session
  std::optional<double> anticipatory_responses;  ///< largest fraction of answers
  std::optional<double> false_alarms;            ///< largest fraction of catch trials
  std::optional<double> out_of_view;  ///< largest fraction of attempts with the effector lost

  bool any() const { return unfinished || anticipatory_responses || false_alarms || out_of_view; }
};

}  // namespace heft
