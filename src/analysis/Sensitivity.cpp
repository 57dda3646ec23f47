#include "analysis/Sensitivity.h"

#include <set>
#include <string>

namespace heft {

std::vector<ReferenceSensitivity> sensitivities_of(const ComparisonTrials& trials) {
  const std::set<std::string> study(trials.participants().begin(), trials.participants().end());
  std::vector<ReferenceSensitivity> all;
  for (const auto& [compared, theirs] : trials.by_compared())
    all.push_back({compared, pooled_sensitivity(answers_by_side(trials, compared), study),
                   trials.as_published(compared)});
  return all;
}

}  // namespace heft
