#include "protocol/study/AnalysisPlan.h"

#include <algorithm>

#include "protocol/toml/TableReader.h"

namespace heft {

namespace {
constexpr Range fractions{0, 1};
constexpr Range margins_percent{least, 50};
}  // namespace

bool AnalysisPlan::declares(std::string_view hypothesis) const {
  const auto found = std::ranges::find(hypothesis_names, hypothesis);
  return found != hypothesis_names.end() &&
         tested.at(static_cast<std::size_t>(found - hypothesis_names.begin()));
}

bool AnalysisPlan::declares_any() const {
  return std::ranges::count(tested, true) > 0;
}

void read_analysis(TableReader& protocol, AnalysisPlan& plan) {
  protocol.in_table("analysis", [&](TableReader& table) {
    for (std::size_t i = 0; i < hypothesis_names.size(); ++i)
      table.read(hypothesis_names.at(i), plan.tested.at(i));
    table.read("equivalence_margin", plan.equivalence_margin, margins_percent);
  });
}

void read_exclusion(TableReader& protocol, ExclusionRules& rules) {
  protocol.in_table("exclusion", [&](TableReader& table) {
    table.read("unfinished", rules.unfinished);
    // Protocols in logs may have the former name.
    table.read("impossible_answers", rules.anticipatory_responses, fractions);
    table.read("anticipatory_responses", rules.anticipatory_responses, fractions);
    table.read("false_alarms", rules.false_alarms, fractions);
    table.read("out_of_view", rules.out_of_view, fractions);
  });
}

}  // namespace heft
