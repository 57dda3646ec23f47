#include "analysis/Sorting.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "analysis/Published.h"

namespace heft {

namespace {
// One condition's trials, by participant.
struct Tallied {
  Tallies correct, incorrect, none, answered_correct, answered_incorrect;
};

void count(Tallies& tallies, const std::string& participant, bool hit) {
  Tally& tally = tallies[participant];
  tally.n_trials += 1;
  tally.n_hits += hit ? 1 : 0;
}

void count_trial(Tallied& tallied, const std::string& participant, Outcome outcome) {
  count(tallied.correct, participant, outcome == Outcome::correct);
  count(tallied.incorrect, participant, outcome == Outcome::incorrect);
  count(tallied.none, participant, outcome == Outcome::dont_know);
  if (outcome == Outcome::dont_know) return;
  count(tallied.answered_correct, participant, outcome == Outcome::correct);
  count(tallied.answered_incorrect, participant, outcome == Outcome::incorrect);
}

bool has_published_masses(const Attempt& attempt) {
  std::vector<double> masses = attempt.masses_g();
  std::ranges::sort(masses);
  return std::ranges::equal(masses, published::sorting_masses_g);
}

void put_beside(Proportion& proportion, const published::Percentage& figure) {
  proportion.published_percent = figure.mean_percent;
  proportion.published_sd_percent = figure.sd_percent;
}

void put_beside(ConditionSorting& sorting, const published::Sorting& figures) {
  put_beside(sorting.correct, figures.correct);
  put_beside(sorting.incorrect, figures.incorrect);
  put_beside(sorting.none, figures.none);
  sorting.answered_correct.published_percent = figures.answered_correct_percent;
}

bool counts(const Attempt& attempt, const std::string& condition) {
  return attempt.completed() && attempt.trial.plan.task == Task::sorting &&
         attempt.trial.plan.condition == condition && attempt.trial.outcome.has_value();
}

ConditionSorting sorting_in(const std::string& condition, std::span<const SessionData> sessions) {
  ConditionSorting sorting;
  sorting.condition = condition;
  Tallied tallied;
  bool as_published = true;
  for (const SessionData& data : sessions) {
    for (const Attempt& attempt : data.attempts) {
      if (!counts(attempt, condition)) continue;
      count_trial(tallied, data.participant(), *attempt.trial.outcome);
      sorting.n_trials_by_cubes[static_cast<int>(attempt.cubes.size())] += 1;
      as_published = as_published && has_published_masses(attempt);
      if (attempt.trial.outcome != Outcome::incorrect) continue;
      const std::vector<double> masses_g = attempt.masses_g();
      const auto labels = final_labels(attempt.answers, static_cast<int>(masses_g.size()));
      if (const auto swap = swap_of(masses_g, labels))
        sorting.swaps.at(static_cast<std::size_t>(*swap)) += 1;
    }
  }
  sorting.correct = proportion_of(tallied.correct);
  sorting.incorrect = proportion_of(tallied.incorrect);
  sorting.none = proportion_of(tallied.none);
  sorting.answered_correct = proportion_of(tallied.answered_correct);
  sorting.answered_incorrect = proportion_of(tallied.answered_incorrect);
  sorting.answered_correct_90_percent = interval_percent_of(tallied.answered_correct, 0.9);
  sorting.n_trials = sorting.correct.trials.n_trials;
  sorting.n_participants = sorting.correct.n_participants;
  if (sorting.n_trials > 0 && as_published)
    put_beside(sorting, condition == "C1" ? published::sorting_c1 : published::sorting_c2);
  return sorting;
}
}  // namespace

double chance_percent(int n_cubes) {
  return 100 / std::tgamma(n_cubes + 1.0);
}

std::optional<double> ConditionSorting::chance_percent() const {
  double sum = 0;
  int n = 0;
  for (const auto& [n_cubes, n_trials_of_these] : n_trials_by_cubes) {
    sum += n_trials_of_these * heft::chance_percent(n_cubes);
    n += n_trials_of_these;
  }
  return n > 0 ? std::optional(sum / n) : std::nullopt;
}

std::vector<std::optional<Label>> final_labels(std::span<const AnswerRow> answers, int n_slots) {
  std::vector<std::optional<Label>> labels(static_cast<std::size_t>(n_slots));
  for (const AnswerRow& answer : answers) {
    if (!answer.slot || *answer.slot < 1 || *answer.slot > n_slots) continue;
    auto& given = labels[static_cast<std::size_t>(*answer.slot - 1)];
    if (answer.action == ActionKind::unlabel) given.reset();
    if (answer.action != ActionKind::label || !answer.label) continue;
    std::ranges::replace(labels, answer.label, std::optional<Label>());
    given = answer.label;
  }
  return labels;
}

std::optional<Swap> swap_of(std::span<const double> masses_g,
                            std::span<const std::optional<Label>> labels) {
  if (masses_g.size() != 3 || labels.size() != 3) return std::nullopt;
  std::array<std::size_t, 3> by_mass{};
  std::iota(by_mass.begin(), by_mass.end(), std::size_t{0});
  std::ranges::stable_sort(by_mass, {}, [&](std::size_t slot) { return masses_g[slot]; });
  std::array<std::optional<Label>, 3> given;  // from the lightest cube to the heaviest
  for (std::size_t rank = 0; rank < 3; ++rank) given.at(rank) = labels[by_mass.at(rank)];

  const auto [light, intermediate, heavy] = given;
  if (!light || !intermediate || !heavy || light == intermediate || light == heavy ||
      intermediate == heavy)
    return std::nullopt;
  const bool light_right = light == Label::lightest;
  const bool intermediate_right = intermediate == Label::intermediate;
  const bool heavy_right = heavy == Label::heaviest;
  if (light_right && intermediate_right) return std::nullopt;
  if (heavy_right) return Swap::light_intermediate;
  if (light_right) return Swap::intermediate_heavy;
  if (intermediate_right) return Swap::light_heavy;
  return Swap::all_three;
}

std::vector<ConditionSorting> sorting_of(std::span<const SessionData> sessions) {
  std::vector<std::string> techniques{"C1", "C2"};  // the paper's first, there or not
  for (const SessionData& data : sessions)
    for (const Attempt& attempt : data.attempts) {
      const TrialPlan& plan = attempt.trial.plan;
      if (plan.task == Task::sorting &&
          std::ranges::find(techniques, plan.condition) == techniques.end())
        techniques.push_back(plan.condition);
    }
  std::vector<ConditionSorting> sorting;
  for (const std::string& technique : techniques)
    sorting.push_back(sorting_in(technique, sessions));
  return sorting;
}

}  // namespace heft
