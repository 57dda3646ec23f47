#include "analysis/Points.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "analysis/Fold.h"
#include "analysis/Sorting.h"
#include "analysis/Timing.h"
#include "base/Quantile.h"

namespace heft {

namespace {
constexpr std::size_t most_bins = 7;

using Trials = std::vector<const ComparedTrial*>;

// Those at 0 together, the others in bins of about as many trials each.
std::vector<Trials> binned(Trials trials) {
  std::ranges::stable_sort(trials, {}, &ComparedTrial::level_g);
  std::vector<Trials> bins;
  const auto zero_end =
      std::ranges::find_if(trials, [](const ComparedTrial* trial) { return trial->level_g > 0; });
  if (zero_end != trials.begin()) bins.emplace_back(trials.begin(), zero_end);
  const auto n = static_cast<std::size_t>(trials.end() - zero_end);
  const std::size_t n_bins = std::min(most_bins, n);
  for (std::size_t i = 0; i < n_bins; ++i) {
    const auto from = static_cast<std::ptrdiff_t>(i * n / n_bins);
    const auto to = static_cast<std::ptrdiff_t>((i + 1) * n / n_bins);
    const auto first = zero_end + from;
    const bool same = i > 0 && bins.back().back()->level_g == (*first)->level_g &&
                      bins.back().front()->level_g == (*(zero_end + to - 1))->level_g;
    if (same)  // many at a bound
      bins.back().insert(bins.back().end(), first, zero_end + to);
    else
      bins.emplace_back(first, zero_end + to);
  }
  return bins;
}

double mean_level_g(const Trials& bin) {
  const double sum = std::accumulate(
      bin.begin(), bin.end(), 0.0,
      [](double so_far, const ComparedTrial* trial) { return so_far + trial->level_g; });
  return sum / static_cast<double>(bin.size());
}

ChoiceBin choice_bin(const Compared& compared, const Trials& bin, const ComparisonTrials& trials) {
  Tallies right, wrong, none;
  for (const ComparedTrial* trial : bin) {
    const std::string& participant = trials.participant(*trial);
    const bool rightly = trial->correct.value_or(false);
    none[participant].add(!trial->difference);
    if (trial->level_g == 0) continue;
    right[participant].add(trial->difference && rightly);
    wrong[participant].add(trial->difference && !rightly);
  }
  ChoiceBin found{compared,       mean_level_g(bin), static_cast<int>(bin.size()),
                  rate_of(right), rate_of(wrong),    rate_of(none)};
  if (trials.participants().size() <= most_lines)
    for (const auto& [participant, tally] : right)
      found.right_percent_of[participant] = tally.percent();
  return found;
}

Quartiles measured(std::string group, double at, const std::deque<double>& values) {
  const auto found = quartiles({values.begin(), values.end()}).value_or(QuartilesOf{});
  return {std::move(group), at,          static_cast<int>(values.size()),
          found.median,     found.lower, found.upper};
}

void put_comparisons(Points& points, const ComparisonTrials& all) {
  for (const auto& [compared, theirs] : all.by_compared()) {
    Trials trials;
    for (const ComparedTrial& trial : theirs) trials.push_back(&trial);
    for (const Trials& bin : binned(std::move(trials))) {
      points.choices.push_back(choice_bin(compared, bin, all));
      std::deque<double> times_s;
      for (const ComparedTrial* trial : bin)
        if (trial->response_s) times_s.push_back(*trial->response_s);
      if (!times_s.empty())
        points.times_by_level.push_back(
            measured(fmt::format("{:g} g", compared.reference_g), mean_level_g(bin), times_s));
    }
  }
}

std::optional<double> percent_of(const Tally& tally) {
  if (tally.n_trials == 0) return std::nullopt;
  return tally.percent();
}

void put_detection(Points& points, const ComparisonTrials& all) {
  std::map<std::string, std::pair<Tally, Tally>> people;  // with a difference, without
  for (const auto& [compared, theirs] : all.by_compared())
    for (const ComparedTrial& trial : theirs) {
      auto& [with, without] = people[all.participant(trial)];
      (trial.level_g == 0 ? without : with).add(trial.difference);
    }
  for (const auto& [participant, tallies] : people) {
    const auto hits = percent_of(tallies.first), alarms = percent_of(tallies.second);
    if (hits && alarms)
      points.detection.push_back(
          {participant, *hits, *alarms, tallies.first.n_trials, tallies.second.n_trials});
  }
}

void count_labels(LabelMatrix& matrix, const Attempt& attempt) {
  const std::vector<double> masses_g = attempt.masses_g();
  const auto labels = final_labels(attempt.answers, 3);
  for (std::size_t slot = 0; slot < 3; ++slot) {
    const auto rank = static_cast<std::size_t>(
        std::ranges::count_if(masses_g, [&](double mass_g) { return mass_g < masses_g[slot]; }));
    const auto words = Sorting::labels_for(3);
    const auto word = std::find(words.begin(), words.end(), labels[slot]);
    if (word != words.end())
      matrix.at(rank).at(static_cast<std::size_t>(word - words.begin())) += 1;
  }
}

constexpr int n_tenths = 10;
}  // namespace

void PointsFold::add_sorting(const std::string& participant, const Attempt& attempt) {
  const TrialRow& trial = attempt.trial;
  if (trial.plan.task != "sorting" || !trial.outcome) return;
  sortings_[participant][trial.plan.condition].add(trial.outcome == "correct");
  if (attempt.cubes.size() == 3 && trial.outcome != "dont_know")
    count_labels(labels_[trial.plan.condition], attempt);
}

void PointsFold::add_times(const SessionData& data) {
  std::map<Task, std::vector<const Attempt*>, InTaskOrder> by_task;
  for (const Attempt& attempt : data.attempts)
    if (attempt.completed() && attempt.trial.plan.task != "introduction")
      by_task[attempt.trial.plan.task].push_back(&attempt);
  for (const auto& [task, attempts] : by_task)
    for (std::size_t i = 0; i < attempts.size(); ++i)
      if (const auto time_s = response_time_s(attempts[i]->trial))
        times_s_[task][static_cast<int>(n_tenths * i / attempts.size())].push_back(*time_s);
}

// Five bands a decade, called by their middle. How far the hand went is what a lag can come to.
void PointsFold::add_lags(const Attempt& attempt) {
  const std::string& condition = attempt.trial.plan.condition;
  for (const CubeRow& cube : attempt.cubes) {
    if (!(cube.mass_g > 0)) continue;
    const double mass_g = std::pow(10, std::round(5 * std::log10(cube.mass_g)) / 5);
    if (cube.peak_lag_m) lag_mm_[condition][mass_g].push_back(1e3 * *cube.peak_lag_m);
    if (cube.peak_lag_m && cube.deepest_push_m)
      lag_mm_[condition + ", the hand's way"][mass_g].push_back(1e3 * *cube.deepest_push_m);
  }
}

void PointsFold::add(const SessionData& data) {
  const std::string participant = data.participant();
  for (const Attempt& attempt : data.attempts) {
    if (!attempt.completed()) continue;
    add_sorting(participant, attempt);
    add_lags(attempt);
  }
  add_times(data);
}

Points PointsFold::result(const ComparisonTrials& trials) const {
  Points points;
  put_comparisons(points, trials);
  put_detection(points, trials);
  points.labels = labels_;
  for (const auto& [participant, conditions] : sortings_) {
    const auto percent_in = [&](const std::string& condition) {
      const auto found = conditions.find(condition);
      return found == conditions.end() ? std::nullopt : percent_of(found->second);
    };
    points.sorting.push_back({participant, percent_in("C1"), percent_in("C2")});
  }
  for (const auto& [task, tenths] : times_s_)
    for (const auto& [tenth, values] : tenths)
      points.times_by_trial.push_back(
          measured(std::string(name_of(task)), 100.0 * (tenth + 0.5) / n_tenths, values));
  for (const auto& [condition, masses] : lag_mm_)
    for (const auto& [mass_g, values] : masses)
      points.lag_by_mass.push_back(measured(condition, mass_g, values));
  return points;
}

Points points_of(std::span<const SessionData> sessions) {
  PointsFold fold;
  for (const SessionData& data : sessions) fold.add(data);
  return fold.result(folded<ComparisonTrials>(sessions));
}

}  // namespace heft
