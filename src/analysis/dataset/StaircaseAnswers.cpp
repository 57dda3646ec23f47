#include "analysis/dataset/StaircaseAnswers.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "analysis/dataset/Jnd.h"
#include "psychophysics/ProcedureKinds.h"
#include "tasks/Comparison.h"
#include "tasks/Judgment.h"

namespace heft {

namespace {
bool is_tested(const Compared& compared) {
  if (compared.method == QuestConfig::kind || compared.method == same_different_method) return true;
  return !compared.block.empty() && !ProcedureKinds::is_bayesian(compared.method);
}

// What an answer says of the level: "yes" or "no", or which side was chosen.
struct Answered {
  bool is_positive = false, is_side = false;
};

std::optional<Answered> answered(const Attempt& attempt, const SessionData& data) {
  const TrialRow& trial = attempt.trial;
  if (attempt.is_usable_comparison(ComparisonAnswers::same_different))
    return Answered{trial.outcome == "difference", false};
  if (trial.plan.task == Comparison::task.name) {
    if (!attempt.is_usable_comparison() || !trial.chosen_slot) return std::nullopt;
    return Answered{*trial.chosen_slot == 2, true};
  }
  const auto asked = data.judgments.find(trial.plan.block);
  if (asked == data.judgments.end() || !trial.value) return std::nullopt;
  const auto& [question, responses] = asked->second;
  const auto meaning = meaning_of(responses, Judgment::choice_of(question, *trial.value));
  if (!meaning || meaning == Meaning::none) return std::nullopt;
  const bool is_side = meaning == Meaning::left || meaning == Meaning::right;
  return Answered{meaning == Meaning::right || meaning == Meaning::positive, is_side};
}
}  // namespace

void StaircaseAnswers::add(const SessionData& data,
                           const std::map<std::string, Compared>& staircases) {
  std::map<std::string, int> n_answered;
  for (const Attempt& attempt : data.attempts) {
    const TrialPlan& plan = attempt.trial.plan;
    const auto found = staircases.find(plan.staircase);
    if (found == staircases.end() || !attempt.completed() || !plan.level_g ||
        !is_tested(found->second))
      continue;
    AnsweredLevels& person = people_[found->second][data.participant()];
    const auto answer = answered(attempt, data);
    if (!answer) continue;
    const bool is_mirrored = answer->is_side && plan.reference_slot.value_or(1) != 1;
    const double level_g = is_mirrored ? -*plan.level_g : *plan.level_g;
    person.answers[level_g][answer->is_positive ? 1 : 0] += 1;
    if (!answer->is_side) n_answered[plan.staircase] += 1;
  }
  for (const auto& [staircase, n] : n_answered) {
    const Compared& compared = staircases.at(staircase);
    const auto run = data.staircases.find(staircase);
    if (run == data.staircases.end()) {
      unknown_.insert(compared);
      continue;
    }
    const bool is_finished = std::ranges::find(data.estimates, staircase,
                                               &EstimateRow::staircase) != data.estimates.end();
    people_[compared][data.participant()].staircases.push_back(
        {run->second.before, is_finished ? std::nullopt : std::optional(n)});
  }
}

std::optional<double> StaircaseAnswers::p_of_random(const Compared& compared) const {
  const auto found = people_.find(compared);
  if (found == people_.end() || unknown_.contains(compared)) return std::nullopt;
  std::vector<AnsweredLevels> people;
  for (const auto& [participant, answers] : found->second)
    if (!answers.answers.empty()) people.push_back(answers);
  if (people.empty()) return std::nullopt;
  return p_of_random_answers(people);
}

std::string StaircaseAnswers::why_random(const Compared& compared) const {
  const auto p = p_of_random(compared);
  if (!p || *p < 0.05) return "";
  return fmt::format(
      "random answers explain these: in the same procedures they depend on the level as much in "
      "{:.0f} % of simulated studies",
      100 * *p);
}

}  // namespace heft
