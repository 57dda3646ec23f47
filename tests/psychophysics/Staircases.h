// Staircases for tests: the paper's, traces of given responses, and random configurations.
#pragma once

#include <rapidcheck.h>

#include <string_view>
#include <vector>

#include "psychophysics/UpDown.h"

namespace heft::test {

/// The paper's staircase for the 15 g reference (its table 2), with Heft's floor.
inline UpDownConfig paper_15g() {
  return {.start = 175, .step = 50, .halve_every = 2, .floor = 0};
}

/// 1-up-1-down with one step, without bounds; every reversal counts.
inline UpDownConfig fixed_step(double start, double step) {
  return {.start = start, .step = step, .discard_reversals = 0};
}

/// The same with a list of steps.
inline UpDownConfig listed_steps(double start, std::vector<double> steps) {
  return {.start = start, .steps = std::move(steps), .discard_reversals = 0};
}

struct Trace {
  std::vector<double> levels;  ///< presented, and the one planned next unless finished
  std::vector<int> reversal_trials;
  std::vector<double> reversal_levels;
};

/// Answers + (positive) and - (negative), until the staircase ends.
inline Trace answer(UpDown& staircase, std::string_view answers) {
  Trace trace;
  for (char sign : answers) {
    trace.levels.push_back(staircase.level());
    const Update update = staircase.respond(sign == '+');
    if (update.reversal) {
      trace.reversal_trials.push_back(staircase.n_trials());
      trace.reversal_levels.push_back(update.reversal->level);
    }
    if (staircase.finished()) return trace;
  }
  trace.levels.push_back(staircase.level());
  return trace;
}

inline Trace answer(const UpDownConfig& config, std::string_view answers) {
  UpDown staircase(config);
  return answer(staircase, answers);
}

/// Any valid staircase; levels and linear steps are multiples of 1/4 so that arithmetic is exact.
inline rc::Gen<UpDownConfig> any_staircase() {
  return rc::gen::exec([] {
    const auto quarter = [](int from, int to) { return *rc::gen::inRange(from, to) / 4.0; };
    const auto choice = [] { return *rc::gen::arbitrary<bool>(); };
    UpDownConfig config;
    config.step_scale = *rc::gen::element(StepScale::linear, StepScale::db, StepScale::log10);
    const bool is_ratio = config.step_scale != StepScale::linear;
    const int most = config.step_scale == StepScale::log10 ? 40 : 200;
    config.start = is_ratio ? quarter(1, 400) : quarter(-400, 400);
    if (choice()) {
      config.steps = *rc::gen::nonEmpty(rc::gen::container<std::vector<double>>(
          rc::gen::map(rc::gen::inRange(1, most), [](int n) { return n / 4.0; })));
      if (choice()) config.steps_up = {quarter(1, most)};
    } else {
      config.step = quarter(1, most);
      config.halve_every = *rc::gen::inRange(0, 4);
      config.min_step = std::min(*config.step, quarter(0, 20));
    }
    config.up = *rc::gen::inRange(1, 4);
    config.down = *rc::gen::inRange(1, 4);
    config.initial_1up1down = choice();
    if (choice()) config.floor = config.start - quarter(0, 400);
    if (is_ratio && config.floor) config.floor = std::max(*config.floor, 0.0);
    if (choice()) config.ceiling = config.start + quarter(1, 400);
    config.at_bound = choice() ? AtBound::clamp : AtBound::virtual_level;
    config.bound_is_reversal = choice();
    config.change_step = choice() ? ChangeStep::before_move : ChangeStep::after_move;
    config.stop_reversals = *rc::gen::inRange(1, 15);
    config.stop_trials = *rc::gen::inRange(1, 100);
    config.min_trials = *rc::gen::inRange(0, std::min(40, config.stop_trials + 1));
    config.discard_reversals = *rc::gen::inRange(0, std::min(5, config.stop_reversals));
    return config;
  });
}

}  // namespace heft::test
