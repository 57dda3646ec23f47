#include "analysis/Proportion.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace heft {

namespace {
double percent_of(const Tally& tally) {
  return 100.0 * tally.n_hits / tally.n_trials;
}

Tally all_together(const Tallies& tallies) {
  Tally all;
  for (const auto& [participant, tally] : tallies) {
    all.n_hits += tally.n_hits;
    all.n_trials += tally.n_trials;
  }
  return all;
}

std::vector<Tally> with_trials(const Tallies& tallies) {
  std::vector<Tally> counted;
  for (const auto& [participant, tally] : tallies)
    if (tally.n_trials > 0) counted.push_back(tally);
  return counted;
}

Interval percent(const Interval& fraction) {
  return {100 * fraction.low, 100 * fraction.high};
}

// A share of so many people, or effective trials, of which the hits need not be whole.
Interval score_interval(double fraction, double n, double t) {
  const double center = fraction + t * t / (2 * n);
  const double half = t * std::sqrt(fraction * (1 - fraction) / n + t * t / (4 * n * n));
  const double scale = 1 + t * t / n;
  return {std::max((center - half) / scale, 0.0), std::min((center + half) / scale, 1.0)};
}

// @param variance of the fraction, by the differences between participants
Interval participants_interval(double fraction, double variance, std::size_t n_participants,
                               double confidence) {
  const double n = static_cast<double>(n_participants);
  if (!(variance > 0)) return exact_interval(fraction * n, n, confidence);
  const double n_effective = std::max(n, fraction * (1 - fraction) / variance);
  return score_interval(fraction, n_effective, student_t_quantile(n - 1, confidence));
}

// The mean over participants of each one's share.
Interval mean_interval(std::span<const Tally> counted, double confidence) {
  std::vector<double> fractions;
  for (const Tally& tally : counted) fractions.push_back(percent_of(tally) / 100);
  const double sd = *sample_sd(fractions), n = static_cast<double>(fractions.size());
  return participants_interval(*mean(fractions), sd * sd / n, counted.size(), confidence);
}

// A share of all trials: a ratio of two sums over participants (Cochran 1977, 6.3).
Interval ratio_interval(std::span<const Tally> counted, const Tally& all) {
  const double fraction = percent_of(all) / 100, n = static_cast<double>(counted.size());
  double square = 0;
  for (const Tally& tally : counted) {
    const double off = tally.n_hits - fraction * tally.n_trials;
    square += off * off;
  }
  const double trials = all.n_trials;
  return participants_interval(fraction, n / (n - 1) * square / (trials * trials), counted.size(),
                               confidence_level);
}
}  // namespace

std::optional<Interval> interval_percent_of(const Tallies& tallies, double confidence) {
  const std::vector<Tally> counted = with_trials(tallies);
  if (counted.empty()) return std::nullopt;
  if (counted.size() > 1) return percent(mean_interval(counted, confidence));
  return percent(exact_interval(counted[0].n_hits, counted[0].n_trials, confidence));
}

Proportion proportion_of(const Tallies& tallies) {
  Proportion proportion;
  std::vector<double> percents;
  for (const Tally& tally : with_trials(tallies)) percents.push_back(percent_of(tally));
  if (percents.empty()) return proportion;
  proportion.trials = all_together(tallies);
  proportion.n_participants = static_cast<int>(percents.size());
  proportion.mean_percent = mean(percents);
  proportion.sd_percent = sample_sd(percents);
  proportion.pooled_percent = percent_of(proportion.trials);
  const bool participants_differ = proportion.sd_percent.value_or(0) > 0;
  proportion.method = participants_differ ? IntervalMethod::participants : IntervalMethod::exact;
  proportion.interval_percent = interval_percent_of(tallies, confidence_level);
  return proportion;
}

Rate rate_of(const Tallies& tallies) {
  const std::vector<Tally> counted = with_trials(tallies);
  Rate rate{all_together(tallies), static_cast<int>(counted.size()), std::nullopt, std::nullopt};
  if (counted.empty()) return rate;
  rate.percent = percent_of(rate.trials);
  rate.interval_percent =
      percent(counted.size() > 1 ? ratio_interval(counted, rate.trials)
                                 : exact_interval(rate.trials.n_hits, rate.trials.n_trials));
  return rate;
}

Rate rate_of_people(const Tally& people) {
  if (people.n_trials == 0) return {people, 0, std::nullopt, std::nullopt};
  return {people, people.n_trials, percent_of(people),
          percent(exact_interval(people.n_hits, people.n_trials))};
}

}  // namespace heft
