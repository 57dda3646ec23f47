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

ComparisonChoices choices(double reference_g, std::optional<double> level_g, const Counts& counts) {
  return {reference_g,
          level_g,
          counts.n_trials,
          rate_of(counts.difference),
          rate_of(counts.wrong_cube),
          rate_of(counts.false_alarm),
          rate_of(counts.at_zero)};
}
using TrialsAtOne = std::vector<const ComparedTrial*>;

// All conditions of a reference together, by level.
std::map<double, TrialsAtOne> by_reference(const ComparisonTrials& trials) {
  std::map<double, TrialsAtOne> references;
  for (const auto& [compared, theirs] : trials.by_compared())
    for (const ComparedTrial& trial : theirs) references[compared.reference_g].push_back(&trial);
  for (auto& [reference_g, theirs] : references)
    std::ranges::stable_sort(theirs, {}, &ComparedTrial::level_g);
  return references;
}

// One level after the other, so that no more than one's counts are in memory.
void put_levels(ComparisonSummary& summary, double reference_g, const TrialsAtOne& sorted,
                const ComparisonTrials& trials) {
  for (auto first = sorted.begin(); first != sorted.end();) {
    const double level_g = (*first)->level_g;
    Counts counts;
    for (; first != sorted.end() && (*first)->level_g == level_g; ++first)
      if (!(*first)->is_catch) count_trial(counts, trials.participant(**first), **first);
    if (counts.n_trials > 0) summary.by_level.push_back(choices(reference_g, level_g, counts));
  }
}
}  // namespace

ComparisonSummary comparisons_of(const ComparisonTrials& trials) {
  ComparisonSummary summary;
  Counts all;
  for (const auto& [reference_g, sorted] : by_reference(trials)) {
    Counts counts;
    for (const ComparedTrial* trial : sorted)
      for (Counts* sum : {&all, &counts}) count_trial(*sum, trials.participant(*trial), *trial);
    summary.by_reference.push_back(choices(reference_g, std::nullopt, counts));
    put_levels(summary, reference_g, sorted, trials);
  }
  summary.wrong_cube = rate_of(all.wrong_cube);
  summary.false_alarm = rate_of(all.false_alarm);
  summary.at_zero = rate_of(all.at_zero);
  return summary;
}

}  // namespace heft
