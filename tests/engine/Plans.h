// Small session plans made in code.
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "psychophysics/ProcedureKinds.h"
#include "tasks/Tasks.h"
#include "tasks/blocks/SessionPlan.h"

namespace heft::testing {

inline Procedure staircase(const std::string& name, double start_g, double step_g,
                           int stop_trials = 30) {
  UpDownConfig config;
  config.start = start_g;
  config.step = step_g;
  config.halve_every = 2;
  config.floor = 0;
  config.stop_reversals = 4;
  config.stop_trials = stop_trials;
  config.discard_reversals = 2;
  return {name, config};
}

/// Demonstration, introduction, four sorting trials, a break, two staircases.
inline SessionPlan small_plan() {
  Introduction::Block introduction{"introduction", {15, 800}};
  Sorting::Block sorting{"sorting", {15, 200, 800}, {{"C1", 2}, {"C2", 2}}, 2};
  Comparison::Block comparison;
  comparison.name = "comparison";
  comparison.staircases = {{15, staircase("15g", 175, 50)}, {200, staircase("200g", 600, 150)}};
  return {{DemonstrationBlock{"demonstration", 20}, introduction, sorting, BreakBlock{"break", 60},
           comparison}};
}

template <typename Plan>
std::shared_ptr<const Plan> shared(Plan plan) {
  return std::make_shared<const Plan>(std::move(plan));
}

}  // namespace heft::testing
