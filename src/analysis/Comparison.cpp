#include "analysis/Comparison.h"

#include <algorithm>
#include <map>
#include <vector>

namespace heft {

namespace {
struct Counts {
  int n_trials = 0;
  Tallies difference, wrong_cube, false_alarm, at_zero;
};

void count_trial(Counts& counts, const std::string& participant, const ComparedTrial& trial) {
  const bool equal = trial.level_g == 0;
  counts.n_trials += 1;
  if (trial.is_catch) counts.false_alarm[participant].add(trial.difference);
  if (!trial.is_catch) counts.difference[participant].add(trial.difference);
  if (!trial.is_catch && equal) counts.at_zero[participant].add(trial.difference);
  if (trial.difference && !equal && trial.correct)
    counts.wrong_cube[participant].add(!*trial.correct);
}

ComparisonChoices choices(const Compared& compared, std::optional<double> level_g,
                          const Counts& counts) {
  return {compared,
          level_g,
          counts.n_trials,
          rate_of(counts.difference),
          rate_of(counts.wrong_cube),
          rate_of(counts.false_alarm),
          rate_of(counts.at_zero)};
}
using TrialsAtOne = std::vector<const ComparedTrial*>;

TrialsAtOne sorted_by_level(const std::deque<ComparedTrial>& trials) {
  TrialsAtOne sorted;
  for (const ComparedTrial& trial : trials) sorted.push_back(&trial);
  std::ranges::stable_sort(sorted, {}, &ComparedTrial::level_g);
  return sorted;
}

// One level after the other, so that no more than one's counts are in memory.
void put_levels(ComparisonSummary& summary, const Compared& compared, const TrialsAtOne& sorted,
                const ComparisonTrials& trials) {
  for (auto first = sorted.begin(); first != sorted.end();) {
    const double level_g = (*first)->level_g;
    Counts counts;
    for (; first != sorted.end() && (*first)->level_g == level_g; ++first)
      if (!(*first)->is_catch) count_trial(counts, trials.participant(**first), **first);
    if (counts.n_trials > 0) summary.by_level.push_back(choices(compared, level_g, counts));
  }
}
}  // namespace

ComparisonSummary comparisons_of(const ComparisonTrials& trials) {
  ComparisonSummary summary;
  Counts all;
  for (const auto& [compared, theirs] : trials.by_compared()) {
    const TrialsAtOne sorted = sorted_by_level(theirs);
    Counts counts;
    for (const ComparedTrial* trial : sorted)
      for (Counts* sum : {&all, &counts}) count_trial(*sum, trials.participant(*trial), *trial);
    summary.by_reference.push_back(choices(compared, std::nullopt, counts));
    put_levels(summary, compared, sorted, trials);
  }
  summary.wrong_cube = rate_of(all.wrong_cube);
  summary.false_alarm = rate_of(all.false_alarm);
  summary.at_zero = rate_of(all.at_zero);
  return summary;
}

}  // namespace heft
