#include "analysis/dataset/ComparisonTrials.h"

#include <algorithm>

#include "tasks/Comparison.h"

namespace heft {

namespace {
SideChosen side_chosen(const TrialRow& trial) {
  if (trial.outcome != "difference" || !trial.chosen_slot) return SideChosen::none;
  return *trial.chosen_slot == 1 ? SideChosen::left : SideChosen::right;
}

// The reference counts as on the left if its place was not logged.
ComparedTrial compared_trial(const TrialRow& trial, std::uint32_t person) {
  return {*trial.plan.level_g,
          response_time_s(trial),
          person,
          side_chosen(trial),
          trial.outcome == "difference",
          trial.plan.is_catch,
          trial.plan.reference_slot.value_or(1) != 1,
          trial.choice_correct};
}
}  // namespace

std::uint32_t ComparisonTrials::place_of(const std::string& participant) {
  const auto [found, is_new] =
      places_.emplace(participant, static_cast<std::uint32_t>(participants_.size()));
  if (is_new) participants_.push_back(participant);
  return found->second;
}

void ComparisonTrials::add(const SessionData& data) {
  const std::string participant = data.participant();
  for (const Attempt& attempt : data.attempts) {
    if (!attempt.is_usable_comparison()) continue;
    const TrialPlan& plan = attempt.trial.plan;
    const Compared compared{*plan.reference_g, plan.condition};
    trials_[compared].push_back(compared_trial(attempt.trial, place_of(participant)));
    comparable_[compared].add(data.published_condition(plan.condition),
                              published::jnd_at(*plan.reference_g) != nullptr);
  }
}

bool ComparisonTrials::as_published(const Compared& compared) const {
  const auto found = comparable_.find(compared);
  return found != comparable_.end() && found->second.condition() == published::Condition::decoupled;
}

std::map<std::string, AnswersByLevel> answers_by_side(const ComparisonTrials& trials,
                                                      const Compared& compared) {
  std::map<std::string, AnswersByLevel> answers;
  for (const ComparedTrial& trial : trials.by_compared().at(compared)) {
    const double signed_g = trial.level_g == 0 ? 0 : trial.right_minus_left_g();  // no -0
    answers[trials.participant(trial)][signed_g][static_cast<std::size_t>(trial.side)] += 1;
  }
  return answers;
}

ComparedTrials pointers_to(const std::deque<ComparedTrial>& trials) {
  ComparedTrials pointers;
  for (const ComparedTrial& trial : trials) pointers.push_back(&trial);
  return pointers;
}

std::vector<ComparedTrials> binned(ComparedTrials sorted) {
  constexpr std::size_t most_bins = 7;
  std::ranges::stable_sort(sorted, {}, &ComparedTrial::level_g);
  std::vector<ComparedTrials> bins;
  const auto put = [&](auto first, auto last) {
    const auto n = static_cast<std::size_t>(last - first);
    const std::size_t n_bins = std::min(most_bins, n);
    auto from = first;
    for (std::size_t i = 0; i < n_bins; ++i) {
      auto to = std::max(from, first + static_cast<std::ptrdiff_t>((i + 1) * n / n_bins));
      while (to != last && to != from && (*to)->level_g == (*(to - 1))->level_g) ++to;
      if (to != from) bins.emplace_back(from, to);
      from = to;
    }
  };
  const auto zero = std::ranges::find_if(sorted, [](const auto* one) { return one->level_g >= 0; });
  const auto above = std::ranges::find_if(sorted, [](const auto* one) { return one->level_g > 0; });
  put(sorted.begin(), zero);
  if (zero != above) bins.emplace_back(zero, above);
  put(above, sorted.end());
  return bins;
}

double mean_level_g(const ComparedTrials& bin) {
  double sum_g = 0;
  for (const ComparedTrial* trial : bin) sum_g += trial->level_g;
  return sum_g / static_cast<double>(bin.size());
}

void StaircaseRuns::add(const SessionData& data) {
  std::map<std::string, std::size_t> places;  // in this session, by staircase
  for (const Attempt& attempt : data.attempts) {
    if (!attempt.is_usable_comparison()) continue;
    const TrialPlan& plan = attempt.trial.plan;
    const Compared compared{*plan.reference_g, plan.condition};
    PersonRuns& person = people_[compared][data.participant()];
    const Response response = Comparison::response_in(attempt.trial, PositiveAnswer::any_choice);
    if (plan.staircase.empty()) {
      person.n_catch += 1;
      person.n_catch_none += response.positive ? 0 : 1;
      continue;
    }
    const auto planned = data.staircases.find(plan.staircase);
    if (planned == data.staircases.end()) {
      unknown_.insert(compared);
      continue;
    }
    const auto [place, is_new] = places.try_emplace(plan.staircase, person.staircases.size());
    if (is_new) person.staircases.push_back(planned->second);
    person.staircases[place->second].choices.push_back({*plan.level_g, *response.choice});
  }
}

std::vector<PersonRuns> StaircaseRuns::take(const Compared& compared) {
  std::vector<PersonRuns> people;
  const auto found = people_.find(compared);
  if (found == people_.end() || unknown_.contains(compared)) return people;
  for (auto& [participant, runs] : found->second) people.push_back(std::move(runs));
  people_.erase(found);
  return people;
}

}  // namespace heft
