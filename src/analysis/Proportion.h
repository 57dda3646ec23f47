// Percentages with their intervals: over participants (Proportion) or over trials (Rate).
#pragma once

#include <map>
#include <optional>
#include <string>

#include "analysis/Statistics.h"
#include "base/Names.h"

namespace heft {

/// Where an interval comes from: Student's t over the participants' percentages; Clopper-Pearson
/// over all trials together, where participants don't differ or there is only one.
enum class IntervalMethod { none, student_t, exact };
template <>
struct EnumNames<IntervalMethod> {
  static constexpr std::array<std::string_view, 3> names{"none", "student_t", "exact"};
};

/// How many of one participant's trials had the property that is counted.
struct Tally {
  int n_hits = 0, n_trials = 0;
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
  std::optional<double> published_percent, published_sd_percent;
};

/// Participants without a trial don't count. The t interval is clipped to 0...100.
Proportion proportion_of(const Tallies& tallies);

/// A percentage of trials, all participants together, with its exact interval.
struct Rate {
  Tally trials;
  std::optional<double> percent;
  std::optional<Interval> interval_percent;
};

Rate rate_of(const Tally& tally);

}  // namespace heft
