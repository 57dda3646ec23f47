#include "inference/Proportion.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace heft {

namespace {
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

// Wilson's score interval of a share of n people or effective trials; hits need not be whole.
Interval score_interval(double fraction, double n, double t) {
  const double center = fraction + t * t / (2 * n);
  const double half = t * std::sqrt(fraction * (1 - fraction) / n + t * t / (4 * n * n));
  const double scale = 1 + t * t / n;
  return {std::max((center - half) / scale, 0.0), std::min((center + half) / scale, 1.0)};
}

// Change of a figure without each participant (jackknife).
using Moves = std::vector<double>;

// If few participants cause most of the variance, its estimate has fewer than n - 1 degrees of
// freedom (Satterthwaite 1946, by the unbiased excess kurtosis; Joanes & Gill 1998). Fewer than ten
// participants cannot estimate the kurtosis, and their intervals are wide enough.
double degrees_of_freedom(const Moves& moves) {
  const double n = static_cast<double>(moves.size());
  if (n < 10) return n - 1;
  double squares = 0, fourths = 0;
  for (const double move : moves) {
    squares += move * move;
    fourths += move * move * move * move;
  }
  const double excess = n * fourths / (squares * squares) - 3;
  const double unbiased = (n - 1) / ((n - 2) * (n - 3)) * ((n + 1) * excess + 6);
  return 2 / (2 / (n - 1) + std::max(unbiased, 0.0) / n);
}

Interval participants_interval(double fraction, const Moves& moves, double confidence) {
  const double n = static_cast<double>(moves.size());
  double variance = 0;
  for (const double move : moves) variance += move * move * (n - 1) / n;
  const double n_effective = std::max(n, fraction * (1 - fraction) / variance);
  return score_interval(fraction, n_effective,
                        student_t_quantile(degrees_of_freedom(moves), confidence));
}

bool all_alike(std::span<const Tally> counted) {
  return std::ranges::all_of(counted, [&](const Tally& tally) {
    return tally.n_hits * counted[0].n_trials == counted[0].n_hits * tally.n_trials;
  });
}

Interval interval_of_alike(std::span<const Tally> counted, double confidence) {
  const double n = static_cast<double>(counted.size());
  return exact_interval(counted[0].percent() / 100 * n, n, confidence);
}

// The mean over participants of each one's share.
Interval mean_interval(std::span<const Tally> counted, double confidence) {
  if (all_alike(counted)) return interval_of_alike(counted, confidence);
  Moves fractions;
  for (const Tally& tally : counted) fractions.push_back(tally.percent() / 100);
  const double center = *mean(fractions), n = static_cast<double>(counted.size());
  for (double& fraction : fractions) fraction = (fraction - center) / (n - 1);
  return participants_interval(center, fractions, confidence);
}

// A share of all trials: a ratio of two sums over participants.
Interval ratio_interval(std::span<const Tally> counted, const Tally& all) {
  if (all_alike(counted)) return interval_of_alike(counted, confidence_level);
  const double fraction = all.percent() / 100;
  Moves moves;
  for (const Tally& tally : counted)
    moves.push_back((tally.n_hits - fraction * tally.n_trials) / (all.n_trials - tally.n_trials));
  return participants_interval(fraction, moves, confidence_level);
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
  for (const Tally& tally : with_trials(tallies)) percents.push_back(tally.percent());
  if (percents.empty()) return proportion;
  proportion.trials = all_together(tallies);
  proportion.n_participants = static_cast<int>(percents.size());
  proportion.mean_percent = mean(percents);
  proportion.sd_percent = sample_sd(percents);
  proportion.pooled_percent = proportion.trials.percent();
  const bool participants_differ = proportion.sd_percent.value_or(0) > 0;
  proportion.method = participants_differ ? IntervalMethod::participants : IntervalMethod::exact;
  proportion.interval_percent = interval_percent_of(tallies, confidence_level);
  return proportion;
}

Rate rate_of(const Tallies& tallies) {
  const std::vector<Tally> counted = with_trials(tallies);
  Rate rate{all_together(tallies), static_cast<int>(counted.size()), std::nullopt, std::nullopt};
  if (counted.empty()) return rate;
  rate.percent = rate.trials.percent();
  rate.interval_percent =
      percent(counted.size() > 1 ? ratio_interval(counted, rate.trials)
                                 : exact_interval(rate.trials.n_hits, rate.trials.n_trials));
  return rate;
}

Rate rate_of_people(const Tally& people) {
  if (people.n_trials == 0) return {people, 0, std::nullopt, std::nullopt};
  return {people, people.n_trials, people.percent(),
          percent(exact_interval(people.n_hits, people.n_trials))};
}

}  // namespace heft
