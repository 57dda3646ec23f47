#include "analysis/Sensitivity.h"

#include <algorithm>
#include <map>
#include <set>

namespace heft {

std::vector<ReferenceSensitivity> sensitivities_of(const ComparisonTrials& trials) {
  const std::set<std::string> study(trials.participants().begin(), trials.participants().end());
  std::vector<ReferenceSensitivity> all;
  for (const auto& [compared, theirs] : trials.by_compared())
    all.push_back({compared, pooled_sensitivity(answers_by_side(trials, compared), study),
                   trials.as_published(compared)});
  return all;
}

namespace {
using Key = std::pair<Compared, std::string>;

// Null: too few people to draw on.
const OwnSensitivity* own_of(const Key& key, std::span<const ReferenceSensitivity> all) {
  const auto reference = std::ranges::find(all, key.first, &ReferenceSensitivity::compared);
  if (reference == all.end()) return nullptr;
  const auto own = reference->pooled.people.find(key.second);
  return own == reference->pooled.people.end() ? nullptr : &own->second;
}

using Results = std::vector<const StaircaseResult*>;

std::map<Key, Results> results_by_person(const std::deque<StaircaseResult>& all) {
  std::map<Key, Results> results;
  for (const StaircaseResult& result : all)
    results[{result.compared, result.participant}].push_back(&result);
  return results;
}

StartedFigure started(const Results& results) {
  std::vector<double> starts_g;
  std::vector<std::optional<CensoredValue>> jnds;
  for (const StaircaseResult* result : results) {
    starts_g.push_back(result->start_g);
    jnds.push_back(censored_value(*result));
  }
  if (results.empty()) return {};
  return {mean(starts_g), mean_figure(jnds)};
}

void put_starts(PersonThreshold& one, const Results& results) {
  const auto [low, high] = std::ranges::minmax(results, {}, &StaircaseResult::start_g);
  const double middle_g = (low->start_g + high->start_g) / 2;
  const bool is_one = low->start_g == high->start_g;
  Results above, below;
  for (const StaircaseResult* result : results)
    (is_one || result->start_g > middle_g ? above : below).push_back(result);
  one.from_above = started(above);
  one.from_below = started(below);
}

std::map<Key, ParticipantJnd> jnds_by_person(std::span<const ReferenceJnd> all) {
  std::map<Key, ParticipantJnd> jnds;
  for (const ReferenceJnd& jnd : all)
    for (const ParticipantJnd& one : jnd.overall.participants)
      jnds[{jnd.compared, one.participant}] = one;
  return jnds;
}
}  // namespace

std::vector<PersonThreshold> thresholds_of(const ComparisonTrials& trials,
                                           const StaircaseFold& staircases,
                                           std::span<const ReferenceSensitivity> pooled) {
  const auto jnds = jnds_by_person(staircases.jnds());
  const auto results = results_by_person(staircases.results());
  std::vector<PersonThreshold> rows;
  for (const auto& [compared, theirs] : trials.by_compared())
    for (const auto& [participant, answers] : answers_by_side(trials, compared)) {
      const Key key{compared, participant};
      const auto [threshold_g, interval_g, why] = own_threshold(answers, own_of(key, pooled));
      PersonThreshold& row = rows.emplace_back(PersonThreshold{compared,
                                                               participant,
                                                               static_cast<int>(trials_in(answers)),
                                                               threshold_g,
                                                               interval_g,
                                                               why,
                                                               {},
                                                               {},
                                                               {}});
      if (const auto found = jnds.find(key); found != jnds.end()) row.jnd = found->second;
      if (const auto found = results.find(key); found != results.end())
        put_starts(row, found->second);
    }
  return rows;
}

}  // namespace heft
