// Properties of every staircase for every sequence of responses.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

#include "psychophysics/Staircases.h"

namespace heft {
namespace {

using test::any_staircase;

std::vector<bool> any_answers() {
  return *rc::gen::container<std::vector<bool>>(150, rc::gen::arbitrary<bool>());
}

/// Calls check(level, update) for every trial until the staircase ends.
template <typename Check>
void play(UpDown& staircase, const std::vector<bool>& answers, const Check& check) {
  for (bool positive : answers) {
    if (staircase.finished()) return;
    const double level = staircase.level();
    check(level, positive, staircase.respond(positive));
  }
}

RC_GTEST_PROP(StaircaseProperty, LevelsStayInBoundsAndFinite, ()) {
  UpDown staircase(*any_staircase());
  const UpDownConfig& config = staircase.config();
  play(staircase, any_answers(), [&](double level, bool, const Update&) {
    RC_ASSERT(std::isfinite(level));
    if (config.floor) RC_ASSERT(level >= *config.floor);
    if (config.ceiling) RC_ASSERT(level <= *config.ceiling);
  });
}

RC_GTEST_PROP(StaircaseProperty, EndsByItsTrialLimitAndNotBeforeItsLeastTrials, ()) {
  UpDown staircase(*any_staircase());
  const UpDownConfig& config = staircase.config();
  play(staircase, any_answers(), [](double, bool, const Update&) {});
  RC_ASSERT(staircase.finished());
  const int n_reversals = static_cast<int>(staircase.reversals().size());
  RC_ASSERT(staircase.n_trials() <= config.stop_trials);
  if (staircase.finish() == StopReason::reversals) {
    RC_ASSERT(n_reversals >= config.stop_reversals);
    RC_ASSERT(staircase.n_trials() >= config.min_trials);
  } else {
    RC_ASSERT(staircase.n_trials() == config.stop_trials);
    RC_ASSERT(n_reversals < config.stop_reversals);
  }
}

RC_GTEST_PROP(StaircaseProperty, ReversalsAlternateAndAreNumbered, ()) {
  UpDownConfig config = *any_staircase();
  config.bound_is_reversal = false;
  UpDown staircase(config);
  int number = 0;
  std::optional<bool> last_positive;
  play(staircase, any_answers(), [&](double level, bool positive, const Update& update) {
    if (!update.reversal) return;
    RC_ASSERT(update.reversal->number == ++number);
    RC_ASSERT(update.reversal->level == level);
    if (last_positive) RC_ASSERT(positive != *last_positive);
    last_positive = positive;
  });
  RC_ASSERT(static_cast<int>(staircase.reversals().size()) == number);
}

RC_GTEST_PROP(StaircaseProperty, OneUpOneDownReversesWhereverTheAnswerChanges, ()) {
  UpDownConfig config = *any_staircase();
  config.bound_is_reversal = false;
  config.up = config.down = 1;
  UpDown staircase(config);
  std::optional<bool> previous;
  play(staircase, any_answers(), [&](double, bool positive, const Update& update) {
    RC_ASSERT(update.reversal.has_value() == (previous && *previous != positive));
    previous = positive;
  });
}

RC_GTEST_PROP(StaircaseProperty, MovesNeverGoAgainstTheAnswer, ()) {
  UpDownConfig config = *any_staircase();
  config.start = std::abs(config.start);  // factors move negative levels in the opposite direction
  config.floor.reset();
  config.ceiling.reset();
  if (config.step_scale == StepScale::linear) config.start = 0;
  UpDown staircase(config);
  play(staircase, any_answers(), [&](double level, bool positive, const Update&) {
    RC_ASSERT((positive ? staircase.level() <= level : staircase.level() >= level));
  });
}

RC_GTEST_PROP(StaircaseProperty, OneSidedAnswersAlwaysEnd, (bool positive)) {
  UpDownConfig config = *any_staircase();
  config.floor = config.start - 1;
  config.ceiling = config.start + 1;
  config.step_scale = StepScale::linear;
  UpDown staircase(config);
  play(staircase, std::vector<bool>(150, positive), [](double, bool, const Update&) {});
  RC_ASSERT(staircase.finished());
  if (!config.bound_is_reversal) RC_ASSERT(staircase.reversals().empty());
}

RC_GTEST_PROP(StaircaseProperty, BoundReversalsEndOneSidedAnswersLongBeforeTheLimit, ()) {
  UpDownConfig config = *any_staircase();
  config.step_scale = StepScale::linear;
  config.start = 10;
  config.floor = 0;
  config.ceiling.reset();
  config.step = 4;
  config.halve_every = 1;
  config.min_step = 1;
  config.steps.clear();
  config.min_trials = 0;
  config.bound_is_reversal = true;
  config.stop_trials = 100;
  UpDown staircase(config);
  play(staircase, std::vector<bool>(100, true), [](double, bool, const Update&) {});
  RC_ASSERT(staircase.finish() == StopReason::reversals);
}

RC_GTEST_PROP(StaircaseProperty, ShownLevelsChangeOnlyTheReversalValues, ()) {
  const UpDownConfig config = *any_staircase();
  UpDown with_level(config), without_level(config);
  for (bool positive : any_answers()) {
    if (without_level.finished()) break;
    RC_ASSERT(with_level.level() == without_level.level());
    const auto with = with_level.respond(positive, 12345.0);
    const auto without = without_level.respond(positive);
    RC_ASSERT(with.reversal.has_value() == without.reversal.has_value());
    if (with.reversal) RC_ASSERT(with.reversal->level == 12345.0);
    RC_ASSERT(with.finish == without.finish);
  }
}

RC_GTEST_PROP(StaircaseProperty, EstimateIsTheMeanOfTheReversalsKept, ()) {
  UpDown staircase(*any_staircase());
  std::vector<double> kept;
  play(staircase, any_answers(), [&](double level, bool, const Update& update) {
    if (update.reversal && update.reversal->number > staircase.config().discard_reversals)
      kept.push_back(level);
  });
  RC_ASSERT(staircase.estimate().has_value() == !kept.empty());
  if (kept.empty()) return;
  long double sum = 0;
  for (double level : kept) sum += level;
  const double mean = static_cast<double>(sum / static_cast<long double>(kept.size()));
  const double largest = std::abs(*std::max_element(
      kept.begin(), kept.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }));
  const double rounding = 1.2e-16 * (static_cast<double>(kept.size()) + 1) * largest;
  RC_ASSERT(std::abs(*staircase.estimate() - mean) <= rounding);
}

}  // namespace
}  // namespace heft
