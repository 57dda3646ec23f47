#include "analysis/Proportion.h"

#include <algorithm>
#include <vector>

namespace heft {

namespace {
double percent_of(const Tally& tally) {
  return 100.0 * tally.n_hits / tally.n_trials;
}

Interval exact_percent(const Tally& tally) {
  const Interval fraction = exact_interval(tally.n_hits, tally.n_trials);
  return {100 * fraction.low, 100 * fraction.high};
}

Interval clipped(const Interval& percent) {
  return {std::max(percent.low, 0.0), std::min(percent.high, 100.0)};
}
}  // namespace

Proportion proportion_of(const Tallies& tallies) {
  Proportion proportion;
  std::vector<double> percents;
  for (const auto& [participant, tally] : tallies) {
    if (tally.n_trials == 0) continue;
    percents.push_back(percent_of(tally));
    proportion.trials.n_hits += tally.n_hits;
    proportion.trials.n_trials += tally.n_trials;
  }
  if (percents.empty()) return proportion;
  proportion.n_participants = static_cast<int>(percents.size());
  proportion.mean_percent = mean(percents);
  proportion.sd_percent = sample_sd(percents);
  proportion.pooled_percent = percent_of(proportion.trials);
  const bool participants_differ = proportion.sd_percent.value_or(0) > 0;
  proportion.method = participants_differ ? IntervalMethod::student_t : IntervalMethod::exact;
  proportion.interval_percent = participants_differ ? clipped(*student_t_interval(percents))
                                                    : exact_percent(proportion.trials);
  return proportion;
}

Rate rate_of(const Tally& tally) {
  if (tally.n_trials == 0) return {tally, std::nullopt, std::nullopt};
  return {tally, percent_of(tally), exact_percent(tally)};
}

}  // namespace heft
