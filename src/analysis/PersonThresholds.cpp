#include "analysis/PersonThresholds.h"

#include <algorithm>
#include <map>

namespace heft {

namespace {
PersonThreshold fitted(const Compared& compared, const std::string& participant,
                       std::span<const Attempt* const> attempts) {
  PersonThreshold one{compared, participant, static_cast<int>(attempts.size()), {}, {}, {}, {}, {}};
  const Fit fit = fit_indecision(answers_by_side(attempts), {.lapse = fixed_lapse});
  one.why = fit.why;
  if (!fit.identifiable()) return one;
  const FittedParameter& threshold = fit.parameter("threshold_75_g");
  one.threshold_75_g = threshold.value;
  one.interval_g = Interval{threshold.low.value_or(0), *threshold.high};
  return one;
}

using Key = std::pair<Compared, std::string>;

std::map<Key, double> starts_by_person(std::span<const SessionData> sessions) {
  std::map<Key, std::vector<double>> starts_g;
  for (const StaircaseResult& result : staircase_results(sessions))
    starts_g[{result.compared, result.participant}].push_back(result.start_g);
  std::map<Key, double> means_g;
  for (const auto& [key, values] : starts_g) means_g[key] = *mean(values);
  return means_g;
}

std::map<Key, ParticipantJnd> jnds_by_person(std::span<const SessionData> sessions) {
  std::map<Key, ParticipantJnd> jnds;
  for (const ReferenceJnd& jnd : jnd_of(sessions))
    for (const ParticipantJnd& one : jnd.participants) jnds[{jnd.compared, one.participant}] = one;
  return jnds;
}
}  // namespace

std::vector<PersonThreshold> thresholds_of(std::span<const SessionData> sessions) {
  const auto jnds = jnds_by_person(sessions);
  const auto starts_g = starts_by_person(sessions);
  std::vector<PersonThreshold> rows;
  for (const auto& [key, attempts] : usable_comparisons(sessions)) {
    PersonThreshold& row = rows.emplace_back(fitted(key.first, key.second, attempts));
    if (const auto found = jnds.find(key); found != jnds.end()) row.jnd = found->second;
    if (const auto found = starts_g.find(key); found != starts_g.end()) row.start_g = found->second;
  }
  return rows;
}

}  // namespace heft
