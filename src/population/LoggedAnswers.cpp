#include "population/LoggedAnswers.h"

#include <fmt/format.h>

#include <cmath>
#include <set>

#include "apparatus/LoggedSession.h"
#include "base/Error.h"
#include "population/Figures.h"
#include "psychophysics/Constant.h"
#include "tasks/Comparison.h"
#include "tasks/Sorting.h"

namespace heft {

namespace {
constexpr double n_answers = 3;  // possible answers to a stimulus, in both tasks

LoggedAnswer answer_of(const TrialRow& trial) {
  const bool are_equal = trial.plan.level_g == 0;
  return {*trial.outcome, are_equal ? std::nullopt : trial.choice_correct};
}

std::set<Stimulus> stimuli_of(const LoggedPeople& logged) {
  std::set<Stimulus> stimuli;
  for (const AnswerCounts& person : logged.people)
    for (const auto& [stimulus, answers] : person) stimuli.insert(stimulus);
  return stimuli;
}

// The techniques of a sorting block.
std::vector<TechniqueTrials> repeated(const std::set<Stimulus>& stimuli, const std::string& block,
                                      int repeats) {
  std::vector<TechniqueTrials> trials;
  for (const Stimulus& one : stimuli)
    if (one.block == block) trials.push_back({one.condition, repeats});
  return trials;
}

// The levels of a comparison block, by condition and reference.
std::vector<ReferenceStaircase> constant_levels(const std::set<Stimulus>& stimuli,
                                                const std::string& block, int repeats) {
  std::map<std::pair<std::string, double>, std::vector<double>> levels_g;
  for (const Stimulus& one : stimuli)
    if (one.block == block) levels_g[{one.condition, *one.reference_g}].push_back(*one.level_g);
  std::vector<ReferenceStaircase> staircases;
  for (const auto& [at, levels] : levels_g)
    staircases.push_back(
        {at.second,
         Procedure(fmt::format("{} {:g}", at.first, at.second), ConstantConfig{levels, repeats}),
         at.first});
  return staircases;
}
}  // namespace

bool add_answer(const TrialRow& trial, AnswerCounts& counts) {
  const TrialPlan& plan = trial.plan;
  const bool is_comparison = plan.task == Comparison::task.name;
  if (trial.status != TrialStatus::completed || plan.is_practice || !trial.outcome) return false;
  if (is_comparison ? !plan.reference_g || !plan.level_g : plan.task != Sorting::task.name)
    return false;
  Stimulus shown{plan.block, plan.condition, {}, {}};
  if (is_comparison) shown.reference_g = plan.reference_g, shown.level_g = plan.level_g;
  ++counts[shown][answer_of(trial)];
  return true;
}

LoggedPeople logged_people(const LogReader& reader, const std::string& db) {
  LoggedPeople logged;
  std::map<std::string, AnswerCounts> by_person;
  for (const std::int64_t id : reader.session_ids()) {
    const LoggedSession session = load_session(reader, db, id);
    if (!logged.protocol) logged.protocol = session.protocol;
    if (session.protocol->sha256 != logged.protocol->sha256)
      throw Error(
          fmt::format("{}: session {} is of another protocol ({}) than the first one ({}); "
                      "expected one protocol",
                      db, id, session.protocol->name, logged.protocol->name));
    AnswerCounts& person = by_person[session.row.header.participant];
    for (const TrialRow& trial : reader.trials(id)) logged.n_trials += add_answer(trial, person);
  }
  for (auto& [participant, counts] : by_person)
    if (!counts.empty()) logged.people.push_back(std::move(counts));
  if (logged.n_trials == 0)
    throw Error(fmt::format("{}: no completed trial of a sorting or comparison block", db));
  return logged;
}

Protocol repeated_stimuli(const LoggedPeople& logged, int repeats) {
  const std::set<Stimulus> stimuli = stimuli_of(logged);
  Protocol protocol = *logged.protocol;
  protocol.screens.questionnaires.clear();
  protocol.blocks.clear();
  for (Block block : logged.protocol->blocks) {
    if (auto* sorting = block_as<Sorting::Block>(block)) {
      sorting->trials = repeated(stimuli, sorting->name, repeats);
      sorting->max_run = 0;
      if (!sorting->trials.empty()) protocol.blocks.push_back(block);
    }
    if (auto* comparison = block_as<Comparison::Block>(block)) {
      comparison->staircases = constant_levels(stimuli, comparison->name, repeats);
      comparison->catch_fraction = 0;
      comparison->catch_trials.clear();
      if (!comparison->staircases.empty()) protocol.blocks.push_back(block);
    }
  }
  return protocol;
}

AnswerCounts answers_of_one(const ResolvedConfig& config, Responder& responder,
                            std::uint64_t seed) {
  AnswerCounts counts;
  run_alone(config, responder, seed, [&](const Event&, const Changes& changes) {
    if (changes.trial) add_answer(*changes.trial, counts);
  });
  return counts;
}

double log_likelihood(const AnswerCounts& logged, const AnswerCounts& simulated) {
  double sum = 0;
  for (const auto& [stimulus, answers] : logged) {
    const auto& drawn = simulated.at(stimulus);
    double n = n_answers / 2;
    for (const auto& [answer, count] : drawn) n += count;
    for (const auto& [answer, count] : answers) {
      const auto found = drawn.find(answer);
      sum += count * std::log(((found == drawn.end() ? 0 : found->second) + 0.5) / n);
    }
  }
  return sum;
}

}  // namespace heft
