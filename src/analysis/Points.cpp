#include "analysis/Points.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "analysis/Sorting.h"
#include "analysis/Timing.h"
#include "base/Quantile.h"

namespace heft {

namespace {
constexpr std::size_t most_bins = 7;

bool is_comparison(const Attempt& attempt) {
  const TrialPlan& plan = attempt.trial.plan;
  return attempt.completed() && plan.task == Task::comparison && attempt.trial.outcome &&
         plan.reference_g && plan.level_g && !plan.is_practice;
}

struct Trial {
  double at = 0;
  const Attempt* attempt = nullptr;
  std::string participant;
};

// Those at 0 together, the others in bins of about as many trials each.
std::vector<std::vector<Trial>> binned(std::vector<Trial> trials) {
  std::ranges::stable_sort(trials, {}, &Trial::at);
  std::vector<std::vector<Trial>> bins;
  const auto zero_end = std::ranges::find_if(trials, [](const Trial& t) { return t.at > 0; });
  if (zero_end != trials.begin()) bins.emplace_back(trials.begin(), zero_end);
  const auto n = static_cast<std::size_t>(trials.end() - zero_end);
  const std::size_t n_bins = std::min(most_bins, n);
  for (std::size_t i = 0; i < n_bins; ++i) {
    const auto from = static_cast<std::ptrdiff_t>(i * n / n_bins);
    const auto to = static_cast<std::ptrdiff_t>((i + 1) * n / n_bins);
    const auto first = zero_end + from;
    const bool same = i > 0 && bins.back().back().at == first->at &&
                      bins.back().front().at == (zero_end + to - 1)->at;
    if (same)  // many at a bound
      bins.back().insert(bins.back().end(), first, zero_end + to);
    else
      bins.emplace_back(first, zero_end + to);
  }
  return bins;
}

double mean_at(std::span<const Trial> bin) {
  const double sum = std::accumulate(bin.begin(), bin.end(), 0.0,
                                     [](double so_far, const Trial& t) { return so_far + t.at; });
  return sum / static_cast<double>(bin.size());
}

ChoiceBin choice_bin(const Compared& compared, std::span<const Trial> bin) {
  Tallies right, wrong, none;
  const auto count = [](Tallies& tallies, const std::string& participant, bool hit) {
    tallies[participant].n_trials += 1;
    tallies[participant].n_hits += hit ? 1 : 0;
  };
  for (const Trial& trial : bin) {
    const TrialRow& row = trial.attempt->trial;
    const bool chosen = row.outcome == Outcome::difference;
    const bool rightly = row.choice_correct.value_or(false);
    count(none, trial.participant, !chosen);
    if (trial.at == 0) continue;
    count(right, trial.participant, chosen && rightly);
    count(wrong, trial.participant, chosen && !rightly);
  }
  return {compared,       mean_at(bin),   static_cast<int>(bin.size()),
          rate_of(right), rate_of(wrong), rate_of(none)};
}

Quartiles measured(std::string group, double at, const std::vector<double>& values) {
  return {std::move(group),
          at,
          static_cast<int>(values.size()),
          quantile(values, 0.5).value_or(0),
          quantile(values, 0.25).value_or(0),
          quantile(values, 0.75).value_or(0)};
}

void put_comparisons(Points& points, std::span<const SessionData> sessions) {
  std::map<Compared, std::vector<Trial>> trials;
  for (const SessionData& data : sessions) {
    const std::string participant = data.participant();
    for (const Attempt& attempt : data.attempts)
      if (is_comparison(attempt)) {
        const TrialPlan& plan = attempt.trial.plan;
        trials[{*plan.reference_g, plan.condition}].push_back(
            {*plan.level_g, &attempt, participant});
      }
  }
  for (const auto& [compared, theirs] : trials)
    for (const std::vector<Trial>& bin : binned(theirs)) {
      points.choices.push_back(choice_bin(compared, bin));
      std::vector<double> times_s;
      for (const Trial& trial : bin)
        if (const auto time = response_time_s(trial.attempt->trial)) times_s.push_back(*time);
      if (!times_s.empty())
        points.times_by_level.push_back(
            measured(fmt::format("{:g} g", compared.reference_g), mean_at(bin), times_s));
    }
}

std::optional<double> percent_of(const Tally& tally) {
  if (tally.n_trials == 0) return std::nullopt;
  return 100.0 * tally.n_hits / tally.n_trials;
}

void put_sortings(Points& points, std::span<const SessionData> sessions) {
  std::map<std::string, std::map<std::string, Tally>> people;
  for (const SessionData& data : sessions)
    for (const Attempt& attempt : data.attempts) {
      const TrialRow& trial = attempt.trial;
      if (!attempt.completed() || trial.plan.task != Task::sorting || !trial.outcome) continue;
      Tally& tally = people[data.participant()][trial.plan.condition];
      tally.n_trials += 1;
      tally.n_hits += trial.outcome == Outcome::correct ? 1 : 0;
      if (attempt.cubes.size() != 3 || trial.outcome == Outcome::dont_know) continue;
      const std::vector<double> masses_g = attempt.masses_g();
      const auto labels = final_labels(attempt.answers, 3);
      LabelMatrix& matrix = points.labels[trial.plan.condition];
      for (std::size_t slot = 0; slot < 3; ++slot) {
        const auto rank = static_cast<std::size_t>(std::ranges::count_if(
            masses_g, [&](double mass_g) { return mass_g < masses_g[slot]; }));
        if (labels[slot] && *labels[slot] <= Label::heaviest)
          matrix.at(rank).at(static_cast<std::size_t>(*labels[slot])) += 1;
      }
    }
  for (auto& [participant, conditions] : people)
    points.sorting.push_back(
        {participant, percent_of(conditions["C1"]), percent_of(conditions["C2"])});
}

void put_detection(Points& points, std::span<const SessionData> sessions) {
  std::map<std::string, std::pair<Tally, Tally>> people;  // with a difference, without
  for (const SessionData& data : sessions)
    for (const Attempt& attempt : data.attempts) {
      if (!is_comparison(attempt)) continue;
      auto& [with, without] = people[data.participant()];
      Tally& tally = *attempt.trial.plan.level_g == 0 ? without : with;
      tally.n_trials += 1;
      tally.n_hits += attempt.trial.outcome == Outcome::difference ? 1 : 0;
    }
  for (const auto& [participant, tallies] : people) {
    const auto hits = percent_of(tallies.first), alarms = percent_of(tallies.second);
    if (hits && alarms)
      points.detection.push_back(
          {participant, *hits, *alarms, tallies.first.n_trials, tallies.second.n_trials});
  }
}

void put_times_by_trial(Points& points, std::span<const SessionData> sessions) {
  constexpr int n_bins = 10;
  std::map<Task, std::map<int, std::vector<double>>> times_s;
  for (const SessionData& data : sessions) {
    std::map<Task, std::vector<const Attempt*>> by_task;
    for (const Attempt& attempt : data.attempts)
      if (attempt.completed() && attempt.trial.plan.task != Task::introduction)
        by_task[attempt.trial.plan.task].push_back(&attempt);
    for (const auto& [task, attempts] : by_task)
      for (std::size_t i = 0; i < attempts.size(); ++i)
        if (const auto time = response_time_s(attempts[i]->trial))
          times_s[task][static_cast<int>(n_bins * i / attempts.size())].push_back(*time);
  }
  for (const auto& [task, bins] : times_s)
    for (const auto& [bin, values] : bins)
      points.times_by_trial.push_back(
          measured(std::string(name_of(task)), 100.0 * (bin + 0.5) / n_bins, values));
}

void put_lag(Points& points, std::span<const SessionData> sessions) {
  std::map<std::string, std::map<double, std::vector<double>>> lags_mm;  // condition, mass
  for (const SessionData& data : sessions)
    for (const Attempt& attempt : data.attempts)
      for (const CubeRow& cube : attempt.cubes)
        if (attempt.completed() && cube.peak_lag_m && cube.mass_g > 0) {
          // Five bands a decade, called by their middle.
          const double band = std::round(5 * std::log10(cube.mass_g));
          lags_mm[attempt.trial.plan.condition][std::pow(10, band / 5)].push_back(1e3 *
                                                                                  *cube.peak_lag_m);
        }
  for (const auto& [condition, masses] : lags_mm)
    for (const auto& [mass_g, values] : masses)
      points.lag_by_mass.push_back(measured(condition, mass_g, values));
}
}  // namespace

Points points_of(std::span<const SessionData> sessions) {
  Points points;
  put_comparisons(points, sessions);
  put_sortings(points, sessions);
  put_detection(points, sessions);
  put_times_by_trial(points, sessions);
  put_lag(points, sessions);
  return points;
}

}  // namespace heft
