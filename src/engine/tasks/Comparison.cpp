#include "engine/tasks/Comparison.h"

#include <algorithm>
#include <array>

#include "engine/tasks/TaskRules.h"

namespace heft {

namespace {
constexpr std::array offered{ActionKind::select, ActionKind::no_difference};

std::optional<Outcome> act(TaskState& state, const Action& action) {
  if (action.kind == ActionKind::no_difference) return Outcome::no_difference;
  choose(state, action.slot.value());
  return Outcome::difference;
}

bool is_unfinished(const Staircase& staircase) {
  return !staircase.finished();
}

std::size_t drawn_unfinished(const std::vector<Staircase>& staircases, RandomStream& stream) {
  std::vector<std::size_t> unfinished;
  for (std::size_t i = 0; i < staircases.size(); ++i)
    if (is_unfinished(staircases[i])) unfinished.push_back(i);
  return unfinished.at(stream.below(unfinished.size()));
}

bool is_positive(const TrialRow& row, PositiveAnswer positive_answer) {
  const bool chosen = row.outcome == Outcome::difference;
  if (positive_answer == PositiveAnswer::any_choice) return chosen;
  return chosen && row.choice_correct.value_or(false);
}

EstimateRow estimate_of(const Staircase& staircase) {
  EstimateRow estimate;
  estimate.staircase = staircase.config().name;
  estimate.method = "mean_of_reversals";
  estimate.jnd_g = staircase.estimate();
  estimate.n_trials = staircase.n_trials();
  estimate.n_reversals = static_cast<int>(staircase.reversals().size());
  estimate.n_floor = staircase.n_floor();
  estimate.n_ceiling = staircase.n_ceiling();
  estimate.reason = name_of(*staircase.finish());
  return estimate;
}
}  // namespace

const TaskRules comparison_rules{
    Task::comparison,
    offered,
    [](const TaskState&, const Action&) -> std::optional<std::string> { return std::nullopt; },
    [](const TaskState&, const Action&) { return true; },
    act,
    [](const TaskState&, ScreenState&) {}};

ComparisonRun::ComparisonRun(const ComparisonBlock& block) : block_(block) {
  for (const ReferenceStaircase& entry : block_.staircases)
    staircases_.emplace_back(entry.staircase);
}

bool ComparisonRun::done() const {
  return std::ranges::none_of(staircases_, is_unfinished);
}

TrialPlan ComparisonRun::plan(const TrialKey& key) const {
  RandomStream catch_stream = key.trial("catch");
  const bool is_catch = catch_stream.coin(block_.catch_fraction);
  RandomStream interleave_stream = key.trial("interleave");
  const std::size_t index =
      is_catch
          ? drawn_unfinished(staircases_, catch_stream)
          : next_staircase(staircases_, block_.interleaving, previous_, interleave_stream).value();
  const ReferenceStaircase& reference = block_.staircases[index];
  TrialPlan plan = key.plan(block_.name, Task::comparison,
                            reference.condition.empty() ? block_.condition : reference.condition);
  plan.is_catch = is_catch;
  if (!is_catch) plan.staircase = reference.staircase.name;
  plan.level_g = is_catch ? 0 : staircases_[index].level();
  plan.reference_g = reference.reference_g;
  plan.reference_slot = key.slots().coin(0.5) ? 1 : 2;
  plan.masses_g = {reference.reference_g, reference.reference_g};
  plan.masses_g[plan.reference_slot == 1 ? 1 : 0] += *plan.level_g;
  return plan;
}

void ComparisonRun::complete(Changes& changes) {
  const std::string& name = changes.trial->plan.staircase;
  for (std::size_t i = 0; i < staircases_.size(); ++i)
    if (block_.staircases[i].staircase.name == name) respond(i, changes);
}

void ComparisonRun::respond(std::size_t index, Changes& changes) {
  Staircase& staircase = staircases_[index];
  const TrialRow& row = *changes.trial;
  const Staircase::Update update = staircase.respond(is_positive(row, block_.positive_answer));
  if (const auto& reversal = update.reversal)
    changes.reversals = {{row.attempt_index, staircase.config().name, reversal->number,
                          reversal->level, reversal->step_before, reversal->step_after}};
  if (update.finish) changes.estimates = {estimate_of(staircase)};
  previous_ = index;
}

std::optional<std::string> ComparisonRun::survivor() const {
  if (staircases_.size() < 2 || std::ranges::count_if(staircases_, is_unfinished) != 1)
    return std::nullopt;
  return std::ranges::find_if(staircases_, is_unfinished)->config().name;
}

}  // namespace heft
