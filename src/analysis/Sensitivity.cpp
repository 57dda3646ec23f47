#include "analysis/Sensitivity.h"

#include <algorithm>
#include <set>
#include <string>

namespace heft {

std::vector<ReferenceSensitivity> sensitivities_of(const ComparisonTrials& trials) {
  const std::set<std::string> study(trials.participants().begin(), trials.participants().end());
  std::vector<ReferenceSensitivity> all;
  for (const auto& [compared, theirs] : trials.by_compared())
    all.push_back({compared, pooled_sensitivity(answers_by_side(trials, compared), study)});
  return all;
}

Interval threshold_ratio_interval(const PooledSensitivity& first, const PooledSensitivity& second,
                                  double confidence) {
  std::vector<double> ratios;
  const std::size_t n =
      std::min(first.sensitivity_samples.size(), second.sensitivity_samples.size());
  for (std::size_t i = 0; i < n; ++i)
    ratios.push_back(first.sensitivity_samples[i] / second.sensitivity_samples[i]);
  return symmetric_interval(*first.sensitivity / *second.sensitivity, ratios,
                            static_cast<std::size_t>(std::min(first.n, second.n)), confidence);
}

}  // namespace heft
