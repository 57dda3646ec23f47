#include "analysis/Sensitivity.h"

#include <algorithm>
#include <map>
#include <set>

namespace heft {

namespace {
enum Side : std::size_t { left, none, right };

bool is_usable(const Attempt& attempt) {
  const TrialRow& trial = attempt.trial;
  return attempt.completed() && trial.plan.task == Task::comparison && trial.outcome &&
         trial.plan.reference_g && trial.plan.level_g && !trial.plan.is_practice;
}

// Without a logged place the reference counts as on the left.
int reference_slot(const TrialRow& trial) {
  return trial.plan.reference_slot.value_or(1);
}

Side side_chosen(const TrialRow& trial) {
  if (trial.outcome != Outcome::difference || !trial.chosen_slot) return none;
  return *trial.chosen_slot == 1 ? left : right;
}
}  // namespace

AnswersByLevel answers_by_side(std::span<const Attempt* const> attempts) {
  AnswersByLevel answers;
  for (const Attempt* attempt : attempts) {
    const TrialRow& trial = attempt->trial;
    const double level_g = *trial.plan.level_g;
    const double signed_g = level_g == 0 ? 0 : reference_slot(trial) == 1 ? level_g : -level_g;
    answers[signed_g][side_chosen(trial)] += 1;
  }
  return answers;
}

std::map<std::pair<Compared, std::string>, std::vector<const Attempt*>> usable_comparisons(
    std::span<const SessionData> sessions) {
  std::map<std::pair<Compared, std::string>, std::vector<const Attempt*>> attempts;
  for (const SessionData& data : sessions) {
    const std::string participant = data.participant();
    for (const Attempt& attempt : data.attempts) {
      const TrialPlan& plan = attempt.trial.plan;
      if (is_usable(attempt))
        attempts[{{*plan.reference_g, plan.condition}, participant}].push_back(&attempt);
    }
  }
  return attempts;
}

std::vector<ReferenceSensitivity> sensitivities_of(std::span<const SessionData> sessions) {
  std::map<Compared, std::map<std::string, AnswersByLevel>> answers;
  std::set<std::string> study;
  for (const auto& [key, attempts] : usable_comparisons(sessions)) {
    answers[key.first][key.second] = answers_by_side(attempts);
    study.insert(key.second);
  }
  const std::vector<StartEffect> effects = start_effects(sessions);
  std::vector<ReferenceSensitivity> all;
  for (const auto& [compared, people] : answers) {
    ReferenceSensitivity one{compared, pooled_sensitivity(people, study), std::nullopt};
    const auto effect = std::ranges::find(effects, compared, &StartEffect::compared);
    if (effect != effects.end()) one.start_effect = *effect;
    all.push_back(std::move(one));
  }
  return all;
}

Interval threshold_ratio_interval(const PooledSensitivity& first, const PooledSensitivity& second,
                                  double confidence) {
  std::vector<double> ratios;
  const std::size_t n =
      std::min(first.sensitivity_samples.size(), second.sensitivity_samples.size());
  for (std::size_t i = 0; i < n; ++i)
    ratios.push_back(first.sensitivity_samples[i] / second.sensitivity_samples[i]);
  return symmetric_interval(*first.sensitivity / *second.sensitivity, ratios,
                            static_cast<std::size_t>(std::min(first.n, second.n)), confidence);
}

}  // namespace heft
