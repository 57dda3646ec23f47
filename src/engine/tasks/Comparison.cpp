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

int n_planned(const ComparisonBlock& block) {
  int n = 0;
  for (const ReferenceCatchTrials& some : block.catch_trials) n += some.trials;
  return n;
}

// In rounds: each reference that has some left, once, in random order.
std::vector<double> catch_references(const ComparisonBlock& block, std::uint64_t seed) {
  std::vector<double> references_g;
  for (int round = 0; static_cast<int>(references_g.size()) < n_planned(block); ++round) {
    std::vector<double> of_round;
    for (const ReferenceCatchTrials& some : block.catch_trials)
      if (some.trials > round) of_round.push_back(some.reference_g);
    RandomStream stream(seed, "catch order/" + block.name, static_cast<std::uint64_t>(round));
    stream.shuffle(std::span(of_round));
    references_g.insert(references_g.end(), of_round.begin(), of_round.end());
  }
  return references_g;
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
  for (const ReferenceStaircase& entry : block_.staircases) staircases_.push_back(entry.staircase);
}

bool ComparisonRun::done() const {
  return std::ranges::none_of(staircases_, is_unfinished) && n_caught_ >= n_planned(block_);
}

// Catch trials come one in each block of `catch_every` trials, at a random place in it.
std::optional<double> ComparisonRun::catch_reference_g(std::uint64_t seed) const {
  constexpr int first_without = 3;
  if (n_caught_ >= n_planned(block_)) return std::nullopt;
  const int block = n_completed_ / block_.catch_every, place = n_completed_ % block_.catch_every;
  const int first = block == 0 ? first_without : 0;
  RandomStream stream(seed, "catch place/" + block_.name, static_cast<std::uint64_t>(block));
  const int drawn =
      first +
      static_cast<int>(stream.below(static_cast<std::uint64_t>(block_.catch_every - first)));
  if (place != drawn && std::ranges::any_of(staircases_, is_unfinished)) return std::nullopt;
  return catch_references(block_, seed).at(static_cast<std::size_t>(n_caught_));
}

// A catch trial is rendered as one of its reference's staircases is.
std::size_t ComparisonRun::staircase_of(double reference_g, RandomStream& stream) const {
  std::vector<std::size_t> its;
  for (std::size_t i = 0; i < staircases_.size(); ++i)
    if (block_.staircases[i].reference_g == reference_g) its.push_back(i);
  return its.at(stream.below(its.size()));
}

// A repeated attempt is drawn freely: its planned side has been seen.
int ComparisonRun::reference_slot(const TrialKey& key, const TrialPlan& plan, int n_before) const {
  if (block_.sides == Sides::random || key.attempt > 1) return key.slots().coin(0.5) ? 1 : 2;
  std::array sides{1, 1, 2, 2};
  RandomStream stream(key.seed, "sides/" + block_.name + "/" + plan.staircase,
                      static_cast<std::uint64_t>(n_before) / sides.size());
  stream.shuffle(std::span<int>(sides));
  return sides[static_cast<std::size_t>(n_before) % sides.size()];
}

TrialPlan ComparisonRun::plan(const TrialKey& key) const {
  RandomStream catch_stream = key.trial("catch");
  const std::optional<double> caught_g = catch_reference_g(key.seed);
  const bool is_catch = caught_g || catch_stream.coin(block_.catch_fraction);
  RandomStream interleave_stream = key.trial("interleave");
  const std::size_t index =
      caught_g ? staircase_of(*caught_g, catch_stream)
      : is_catch
          ? drawn_unfinished(staircases_, catch_stream)
          : next_staircase(staircases_, block_.interleaving, previous_, interleave_stream).value();
  const ReferenceStaircase& reference = block_.staircases[index];
  TrialPlan plan = key.plan(block_.name, Task::comparison,
                            reference.condition.empty() ? block_.condition : reference.condition);
  plan.is_catch = is_catch;
  if (!is_catch) plan.staircase = reference.staircase.name();
  plan.level_g =
      is_catch ? 0 : staircases_[index].next_level(level_stream(key.seed, plan.staircase));
  plan.reference_g = reference.reference_g;
  plan.reference_slot =
      reference_slot(key, plan, is_catch ? n_caught_ : staircases_[index].n_trials());
  plan.masses_g = {reference.reference_g, reference.reference_g};
  plan.masses_g[plan.reference_slot == 1 ? 1 : 0] += *plan.level_g;
  return plan;
}

void ComparisonRun::complete(Changes& changes) {
  ++n_completed_;
  if (changes.trial->plan.is_catch) ++n_caught_;
  const std::string& name = changes.trial->plan.staircase;
  for (std::size_t i = 0; i < staircases_.size(); ++i)
    if (staircases_[i].name() == name) respond(i, changes);
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
