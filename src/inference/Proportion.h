// Percentages with their intervals: over participants (Proportion) or over trials (Rate).
#pragma once

#include <map>
#include <optional>
#include <string>

#include "base/Names.h"
#include "inference/Statistics.h"

namespace heft {

/// Where an interval comes from. The unit is the participant.
///
/// - participants: a score interval (Wilson 1927) with an effective number of trials, which is
///   smaller the more participants differ (Korn & Graubard 1998), and Student's t instead of the
///   normal quantile. The variance is the jackknife's (Efron & Stein 1981), which is not too small
///   where a few participants have most of the trials. Degrees of freedom: the number of
///   participants less one, or fewer where a few of them cause most of the spread (Satterthwaite
///   1946).
/// - exact: Clopper-Pearson over people where all have the same share; with one participant over
///   the trials, so that the interval is about this person only.
enum class IntervalMethod { none, participants, exact };
template <>
struct EnumNames<IntervalMethod> {
  static constexpr std::array<std::string_view, 3> names{"none", "participants", "exact"};
};

/// How many of one participant's trials had the property that is counted.
struct Tally {
  int n_hits = 0, n_trials = 0;

  void add(bool hit) {
    n_trials += 1;
    n_hits += hit ? 1 : 0;
  }
  double percent() const { return 100.0 * n_hits / n_trials; }  ///< where there are trials
};

/// Tallies by participant.
using Tallies = std::map<std::string, Tally>;

/// The mean over participants of each one's percentage.
struct Proportion {
  std::optional<double> mean_percent;
  std::optional<double> sd_percent;  ///< between participants, n-1
  std::optional<Interval> interval_percent;
  IntervalMethod method = IntervalMethod::none;
  std::optional<double> pooled_percent;  ///< over all trials together
  int n_participants = 0;                ///< those with at least one trial
  Tally trials;                          ///< all together
};

/// Participants without a trial don't count.
Proportion proportion_of(const Tallies& tallies);

/// The same figure's interval at another confidence; none without trials.
std::optional<Interval> interval_percent_of(const Tallies& tallies, double confidence);

/// A percentage of the trials of all participants together, so that each trial has equal weight.
struct Rate {
  Tally trials;
  int n_participants = 0;  ///< with a trial
  std::optional<double> percent;
  std::optional<Interval> interval_percent;
};

/// Clusters are the participants.
Rate rate_of(const Tallies& tallies);

/// Share of people: Clopper-Pearson interval.
Rate rate_of_people(const Tally& people);

}  // namespace heft
