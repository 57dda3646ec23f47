#include "analysis/Comparison.h"

#include <map>
#include <utility>

namespace heft {

namespace {
struct Counts {
  int n_trials = 0;
  Tallies difference, wrong_cube, false_alarm, at_zero;
};

void count(Tallies& tallies, const std::string& participant, bool hit) {
  Tally& tally = tallies[participant];
  tally.n_trials += 1;
  tally.n_hits += hit ? 1 : 0;
}

void count_trial(Counts& counts, const std::string& participant, const TrialRow& trial) {
  const bool chosen = trial.outcome == Outcome::difference;
  const bool equal = trial.plan.level_g.value_or(0) == 0;
  counts.n_trials += 1;
  if (trial.plan.is_catch) count(counts.false_alarm, participant, chosen);
  if (!trial.plan.is_catch) count(counts.difference, participant, chosen);
  if (!trial.plan.is_catch && equal) count(counts.at_zero, participant, chosen);
  if (chosen && !equal && trial.choice_correct)
    count(counts.wrong_cube, participant, !*trial.choice_correct);
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
    const std::string participant = data.participant();
    for (const Attempt& attempt : data.attempts) {
      const TrialRow& trial = attempt.trial;
      if (!attempt.completed() || trial.plan.task != Task::comparison) continue;
      if (!trial.outcome || !trial.plan.reference_g) continue;
      const double reference_g = *trial.plan.reference_g;
      count_trial(all, participant, trial);
      count_trial(by_reference[reference_g], participant, trial);
      if (!trial.plan.is_catch)
        count_trial(by_level[{reference_g, trial.plan.level_g.value_or(0)}], participant, trial);
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
