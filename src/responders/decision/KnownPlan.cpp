#include "responders/decision/KnownPlan.h"

#include <algorithm>
#include <cmath>

#include "responders/decision/Decision.h"
#include "tasks/blocks/SessionPlan.h"

namespace heft {

namespace {
bool is_of(const ReferenceStaircase& staircase, const TrialPlan& plan) {
  return plan.staircase.empty() ? staircase.reference_g == plan.reference_g
                                : staircase.staircase.name() == plan.staircase;
}
}  // namespace

TrialTruth truth_of(const SessionPlan& session, const TrialPlan& plan) {
  TrialTruth truth{plan.masses_g, plan.level_g, {}};
  const auto staircases = task_block(session, plan.block).staircases();
  const auto found = std::ranges::find_if(
      staircases, [&](const ReferenceStaircase& one) { return is_of(one, plan); });
  if (found == staircases.end()) return truth;
  const std::vector<double> levels_g = found->staircase.planned_levels();
  if (!levels_g.empty()) truth.start_g = std::ranges::max(levels_g);
  return truth;
}

Answer start_anchored_answer(const ResponderParameters& parameters, const TrialView& trial,
                             std::span<const int> wrong_slots, RandomStream& stream) {
  const double noise = parameters.anchor_noise * stream.normal();
  const bool guess = stream.coin(parameters.p);
  const bool has_start =
      trial.truth && trial.truth->level_g && trial.truth->start_g && *trial.truth->start_g != 0;
  const bool differ =
      has_start ? *trial.truth->level_g / *trial.truth->start_g + noise > parameters.anchor_fraction
                : guess;
  return blind_answer(trial, {trial.stage.n_slots(), differ, wrong_slots}, stream);
}

Answer weber_answer(const ResponderParameters& parameters, const TrialView& trial,
                    std::span<const int> wrong_slots, RandomStream& stream) {
  Percepts percepts;
  percepts.wrong_slots = wrong_slots;
  std::vector<double> masses_g(static_cast<std::size_t>(trial.stage.n_slots()), 0);
  if (trial.truth) std::ranges::copy(trial.truth->masses_g, masses_g.begin());
  if (trial.lifted_g) masses_g.push_back(*trial.lifted_g);
  for (const double mass_g : masses_g)
    percepts.remembered_mm.push_back(mm_per_g * mass_g *
                                     std::exp(parameters.weber_noise * stream.normal()));
  const auto [smallest, largest] = std::ranges::minmax(percepts.remembered_mm);
  percepts.differ = largest > (1 + parameters.weber_fraction) * smallest;
  return simulated_answer(trial.task, trial.offer, percepts, stream);
}

}  // namespace heft
