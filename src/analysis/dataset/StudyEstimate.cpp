#include "analysis/dataset/StudyEstimate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/math/Quantiles.h"

namespace heft {

std::string StudyEstimate::text_at(std::string_view name) const {
  if (name == "task") return task;
  if (name == "condition") return condition;
  if (name == "participant") return participant;
  if (name == "reference_g") return reference_g ? fmt::format("{:g}", *reference_g) : "";
  const Coordinate* found = at(name);
  return found ? found->text : "";
}

std::vector<const StudyEstimate*> estimates_of(const Estimates& estimates, std::string_view measure,
                                               std::initializer_list<Place> places) {
  std::vector<const StudyEstimate*> found;
  for (const StudyEstimate& one : estimates)
    if (one.measure->name == measure && std::ranges::all_of(places, [&](const Place& place) {
          return one.text_at(place.first) == place.second;
        }))
      found.push_back(&one);
  return found;
}

const StudyEstimate* find_estimate(const Estimates& estimates, std::string_view measure,
                                   std::initializer_list<Place> places) {
  const auto found = estimates_of(estimates, measure, places);
  return found.empty() ? nullptr : found.front();
}

std::string_view beyond_sign(Censored censored) {
  if (censored == Censored::none || censored == Censored::indeterminate) return "";
  return censored == Censored::above ? "> " : "< ";
}

Coordinate at(std::string_view name, double value) {
  return {name, fmt::format("{:g}", value), value};
}

std::optional<Interval> interval_of(const published::Figure& figure) {
  if (figure.sd) return student_t_interval(figure.value, *figure.sd, published::n_participants);
  if (!figure.n_hits) return std::nullopt;
  const Interval shares = exact_interval(*figure.n_hits, published::n_participants);
  return Interval{100 * shares.low, 100 * shares.high};
}

StudyEstimate quartiles_estimate(const Measure& measure, const std::deque<double>& values) {
  StudyEstimate estimate{&measure};
  estimate.n_trials = static_cast<int>(values.size());
  estimate.method = "quartiles";
  if (const auto found = quartiles({values.begin(), values.end()})) {
    estimate.value = found->median;
    estimate.low = found->lower;
    estimate.high = found->upper;
  }
  return estimate;
}

StudyEstimate rate_estimate(const Measure& measure, const Rate& rate) {
  StudyEstimate estimate{&measure};
  estimate.value = rate.percent;
  estimate.set(rate.interval_percent);
  estimate.n = rate.n_participants;
  estimate.n_trials = rate.trials.n_trials;
  estimate.n_hits = rate.trials.n_hits;
  return estimate;
}

StudyEstimate own_share(const Measure& measure, const std::string& participant,
                        const Tally& tally) {
  StudyEstimate own{&measure};
  own.participant = participant;
  own.value = tally.percent();
  own.n = 1;
  own.n_trials = tally.n_trials;
  own.n_hits = tally.n_hits;
  return own;
}

namespace {
// Why participants have no value; with different reasons, how many have each, the most frequent
// first.
std::string reasons_of(const std::vector<const StudyEstimate*>& people) {
  std::vector<std::pair<std::string, int>> reasons;
  for (const StudyEstimate* own : people) {
    if (own->value || own->why.empty()) continue;
    const auto found = std::ranges::find(reasons, own->why, &std::pair<std::string, int>::first);
    if (found == reasons.end())
      reasons.emplace_back(own->why, 1);
    else
      found->second += 1;
  }
  std::ranges::stable_sort(reasons, std::greater(), &std::pair<std::string, int>::second);
  if (reasons.size() == 1) return reasons.front().first;
  std::string text;
  for (const auto& [why, n] : reasons)
    text += fmt::format("{}{} ({})", text.empty() ? "" : "; ", why, n);
  return text;
}

// Equal values say nothing about how people differ: an interval of no width would be wrong.
std::optional<Interval> interval_over(const std::vector<double>& values) {
  constexpr double rounding = 1e-12;
  if (sample_sd(values).value_or(0) <= rounding * std::abs(*mean(values))) return std::nullopt;
  return student_t_interval(values);
}
}  // namespace

StudyEstimate mean_over_people(const std::vector<const StudyEstimate*>& people, bool of_logs) {
  StudyEstimate estimate = *people.front();
  std::vector<double> values;
  estimate.n_trials = 0;
  for (const StudyEstimate* own : people) {
    estimate.n_trials += own->n_trials;
    if (own->value) values.push_back(of_logs ? std::log(*own->value) : *own->value);
  }
  estimate.participant.clear();
  estimate.value = mean(values);
  estimate.low = estimate.high = std::nullopt;  // those of the first
  if (!values.empty()) estimate.set(interval_over(values));
  if (!of_logs) estimate.sd = sample_sd(values);
  for (auto* figure : {&estimate.value, &estimate.low, &estimate.high})
    if (of_logs && *figure) *figure = std::exp(**figure);
  estimate.n = static_cast<int>(values.size());
  estimate.method = of_logs ? "Student's t of logarithms" : "Student's t";
  if (values.size() < people.size())
    estimate.why = fmt::format("{} of {} participants have none: {}", people.size() - values.size(),
                               people.size(), reasons_of(people));
  return estimate;
}

StudyEstimate over_people(const std::vector<const StudyEstimate*>& people, bool of_logs) {
  if (people.size() > 1) return mean_over_people(people, of_logs);
  StudyEstimate estimate = *people.front();
  estimate.participant.clear();
  estimate.n = estimate.value ? 1 : 0;
  return estimate;
}

std::vector<const StudyEstimate*> published_among(const Estimates& estimates) {
  std::vector<const StudyEstimate*> found;
  for (const StudyEstimate& one : estimates)
    if (one.published && std::ranges::none_of(found, [&](const StudyEstimate* other) {
          return other->published == one.published && other->condition == one.condition;
        }))
      found.push_back(&one);
  return found;
}

}  // namespace heft
