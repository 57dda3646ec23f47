#include "analysis/ComparisonTrials.h"

#include "analysis/Timing.h"

namespace heft {

namespace {
bool is_usable(const Attempt& attempt) {
  const TrialRow& trial = attempt.trial;
  return attempt.completed() && trial.plan.task == "comparison" && trial.outcome &&
         trial.plan.reference_g && trial.plan.level_g && !trial.plan.is_practice;
}

SideChosen side_chosen(const TrialRow& trial) {
  if (trial.outcome != "difference" || !trial.chosen_slot) return SideChosen::none;
  return *trial.chosen_slot == 1 ? SideChosen::left : SideChosen::right;
}

// Without a logged place the reference counts as on the left.
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
    if (!is_usable(attempt)) continue;
    const TrialPlan& plan = attempt.trial.plan;
    trials_[{*plan.reference_g, plan.condition}].push_back(
        compared_trial(attempt.trial, place_of(participant)));
  }
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

}  // namespace heft
