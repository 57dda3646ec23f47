#include "analysis/Comparison.h"

#include <map>
#include <utility>

namespace heft {

namespace {
struct Counts {
  int n_trials = 0;
  Tally difference, wrong_cube, false_alarm, at_zero;
};

void count(Tally& tally, bool hit) {
  tally.n_trials += 1;
  tally.n_hits += hit ? 1 : 0;
}

void count_trial(Counts& counts, const TrialRow& trial) {
  const bool chosen = trial.outcome == Outcome::difference;
  const bool equal = trial.plan.level_g.value_or(0) == 0;
  counts.n_trials += 1;
  if (trial.plan.is_catch) count(counts.false_alarm, chosen);
  if (!trial.plan.is_catch) count(counts.difference, chosen);
  if (!trial.plan.is_catch && equal) count(counts.at_zero, chosen);
  if (chosen && !equal && trial.choice_correct) count(counts.wrong_cube, !*trial.choice_correct);
}

ComparisonChoices choices(double reference_g, std::optional<double> level_g, const Counts& counts) {
  return {reference_g,
          level_g,
          counts.n_trials,
          rate_of(counts.difference),
          rate_of(counts.wrong_cube),
          rate_of(counts.false_alarm),
          rate_of(counts.at_zero)};
}
}  // namespace

ComparisonSummary comparisons_of(std::span<const SessionData> sessions) {
  Counts all;
  std::map<double, Counts> by_reference;
  std::map<std::pair<double, double>, Counts> by_level;
  for (const SessionData& data : sessions) {
    for (const Attempt& attempt : data.attempts) {
      const TrialRow& trial = attempt.trial;
      if (!attempt.completed() || trial.plan.task != Task::comparison) continue;
      if (!trial.outcome || !trial.plan.reference_g) continue;
      const double reference_g = *trial.plan.reference_g;
      count_trial(all, trial);
      count_trial(by_reference[reference_g], trial);
      if (!trial.plan.is_catch)
        count_trial(by_level[{reference_g, trial.plan.level_g.value_or(0)}], trial);
    }
  }
  ComparisonSummary summary;
  for (const auto& [reference_g, counts] : by_reference)
    summary.by_reference.push_back(choices(reference_g, std::nullopt, counts));
  for (const auto& [key, counts] : by_level)
    summary.by_level.push_back(choices(key.first, key.second, counts));
  summary.wrong_cube = rate_of(all.wrong_cube);
  summary.false_alarm = rate_of(all.false_alarm);
  summary.at_zero = rate_of(all.at_zero);
  return summary;
}

}  // namespace heft
