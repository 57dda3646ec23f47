#include "engine/tasks/Comparison.h"

#include <algorithm>
#include <array>

#include "engine/tasks/TaskRules.h"
#include "psychophysics/Procedure.h"

namespace heft {

namespace {
constexpr std::array offered{ActionKind::select, ActionKind::no_difference};

std::optional<Outcome> act(TaskState& state, const Action& action) {
  if (action.kind == ActionKind::no_difference) return Outcome::no_difference;
  choose(state, action.slot.value());
  return Outcome::difference;
}

bool is_unfinished(const Procedure& staircase) {
  return !staircase.finished();
}

std::size_t drawn_unfinished(const std::vector<Procedure>& staircases, RandomStream& stream) {
  std::vector<std::size_t> unfinished;
  for (std::size_t i = 0; i < staircases.size(); ++i)
    if (is_unfinished(staircases[i])) unfinished.push_back(i);
  return unfinished.at(stream.below(unfinished.size()));
}

// Positive by the block's rule, and which was chosen.
Response response_in(const TrialRow& row, PositiveAnswer positive_answer) {
  if (row.outcome != Outcome::difference) return response_of(Choice::none);
  Response response = response_of(row.chosen_slot == row.plan.reference_slot ? Choice::reference
                                                                             : Choice::comparison);
  if (positive_answer == PositiveAnswer::correct_choice)
    response.positive = row.choice_correct.value_or(false);
  return response;
}

EstimateRow row_of(const std::string& staircase, const Estimate& estimate, Finish finish) {
  EstimateRow row;
  row.staircase = staircase;
  row.method = estimate.method;
  row.jnd_g = estimate.value;
  row.low_g = estimate.low;
  row.high_g = estimate.high;
  row.n_trials = estimate.n_trials;
  row.n_reversals = estimate.n_reversals;
  row.n_floor = estimate.n_floor;
  row.n_ceiling = estimate.n_ceiling;
  row.reason = finish;
  row.censored = estimate.censored;
  return row;
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
ComparisonRun::ComparisonRun(ComparisonRun&&) noexcept = default;
ComparisonRun& ComparisonRun::operator=(ComparisonRun&&) noexcept = default;
ComparisonRun::~ComparisonRun() = default;

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
  plan.level_g =
      is_catch ? 0 : staircases_[index].next_level(level_stream(key.seed, plan.staircase));
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
  Procedure& staircase = staircases_[index];
  const TrialRow& row = *changes.trial;
  const Update update =
      staircase.respond(response_in(row, block_.positive_answer), *row.plan.level_g);
  if (const auto& reversal = update.reversal)
    changes.reversals = {{row.attempt_index, staircase.name(), reversal->number, reversal->level,
                          reversal->step_before, reversal->step_after}};
  if (update.finish)
    for (const Estimate& estimate : staircase.estimates())
      changes.estimates.push_back(row_of(staircase.name(), estimate, *update.finish));
  previous_ = index;
}

std::optional<std::string> ComparisonRun::survivor() const {
  if (staircases_.size() < 2 || std::ranges::count_if(staircases_, is_unfinished) != 1)
    return std::nullopt;
  return std::ranges::find_if(staircases_, is_unfinished)->name();
}

}  // namespace heft
