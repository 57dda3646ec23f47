#include "analysis/Sorting.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "tasks/Sorting.h"

namespace heft {

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
    if (answer.action == "unlabel") given.reset();
    if (answer.action != "label" || !answer.label) continue;
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
  const bool light_right = light == "lightest";
  const bool intermediate_right = intermediate == "intermediate";
  const bool heavy_right = heavy == "heaviest";
  if (light_right && intermediate_right) return std::nullopt;
  if (heavy_right) return Swap::light_intermediate;
  if (light_right) return Swap::intermediate_heavy;
  if (intermediate_right) return Swap::light_heavy;
  return Swap::all_three;
}

namespace {
// Which label each cube got, both by rank.
void count_labels(std::map<int, std::vector<std::vector<int>>>& matrices,
                  std::span<const double> masses_g, std::span<const std::optional<Label>> labels) {
  const auto names = Sorting::labels_for(static_cast<int>(masses_g.size()));
  auto& matrix = matrices[static_cast<int>(masses_g.size())];
  matrix.resize(masses_g.size(), std::vector<int>(masses_g.size()));
  for (std::size_t slot = 0; slot < masses_g.size(); ++slot) {
    const auto rank = static_cast<std::size_t>(
        std::ranges::count_if(masses_g, [&](double mass_g) { return mass_g < masses_g[slot]; }));
    const auto label = std::find(names.begin(), names.end(), labels[slot]);
    if (label != names.end()) matrix[rank][static_cast<std::size_t>(label - names.begin())] += 1;
  }
}
}  // namespace

void SortingFold::count(Counted& counted, const std::string& participant, const Attempt& attempt) {
  const Outcome outcome = *attempt.trial.outcome;
  counted.correct[participant].add(outcome == "correct");
  counted.incorrect[participant].add(outcome == "incorrect");
  counted.none[participant].add(outcome == "dont_know");
  counted.n_trials_by_cubes[static_cast<int>(attempt.cubes.size())] += 1;
  if (outcome == "dont_know") return;
  counted.answered_correct[participant].add(outcome == "correct");
  counted.answered_incorrect[participant].add(outcome == "incorrect");
  const std::vector<double> masses_g = attempt.masses_g();
  const auto labels = final_labels(attempt.answers, static_cast<int>(masses_g.size()));
  count_labels(counted.labels, masses_g, labels);
  if (outcome != "incorrect") return;
  if (const auto swap = swap_of(masses_g, labels))
    counted.swaps.at(static_cast<std::size_t>(*swap)) += 1;
}

void SortingFold::add(const SessionData& data) {
  const std::string participant = data.participant();
  for (const Attempt& attempt : data.attempts) {
    if (attempt.trial.plan.task != "sorting") continue;
    const std::string& condition = attempt.trial.plan.condition;
    Counted& counted = conditions_[condition];
    if (!attempt.completed() || !attempt.trial.outcome) continue;
    count(counted, participant, attempt);
    counted.comparable.add(data.published_condition(condition),
                           attempt.shows(published::sorting_masses_g));
  }
}

ConditionSorting SortingFold::sorting_in(const std::string& condition, const Counted& counted) {
  ConditionSorting sorting;
  sorting.condition = condition;
  sorting.swaps = counted.swaps;
  sorting.n_trials_by_cubes = counted.n_trials_by_cubes;
  sorting.correct = proportion_of(counted.correct);
  sorting.incorrect = proportion_of(counted.incorrect);
  sorting.none = proportion_of(counted.none);
  sorting.answered_correct = proportion_of(counted.answered_correct);
  sorting.answered_incorrect = proportion_of(counted.answered_incorrect);
  sorting.answered_correct_90_percent = interval_percent_of(counted.answered_correct, 0.9);
  sorting.n_trials = sorting.correct.trials.n_trials;
  sorting.n_participants = sorting.correct.n_participants;
  sorting.correct_by_participant = counted.correct;
  sorting.labels = counted.labels;
  sorting.published = counted.comparable.condition();
  return sorting;
}

std::vector<ConditionSorting> SortingFold::result() const {
  std::vector<ConditionSorting> sorting;
  for (const auto& [condition, counted] : conditions_)
    sorting.push_back(sorting_in(condition, counted));
  return sorting;
}

}  // namespace heft
