// Adjustments: order and first masses of trials, steps and their limits, what simulated
// participants set. Whole sessions of every task are in every_task_test.cpp.
#include "tasks/Adjustment.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "base/files/TextFile.h"
#include "replay/Replay.h"
#include "replay/StoredSession.h"
#include "tasks/Plans.h"
#include "tasks/blocks/SessionPlan.h"

namespace heft {
namespace {
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::Ge;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Le;
using testing::plans;
using testing::StoredSession;

Adjustment::Block block_of(std::vector<double> references_g, int trials = 2) {
  Adjustment::Block block;
  block.name = "adjust";
  block.reference_g.values = std::move(references_g);
  block.start_g = {50, 500};
  block.steps_g = {50, 10};
  block.trials = {{"C2", trials}};
  return block;
}

double comparison_g(const TrialPlan& plan) {
  return plan.masses_g.at(plan.reference_slot == 1 ? 1 : 0);
}

TEST(AdjustmentRun, ShowsEachReferenceWithEachTechniqueAsOftenAsPlanned) {
  Adjustment::Block block = block_of({100, 200}, 3);
  block.trials.push_back({"C1", 1});
  std::map<std::pair<double, std::string>, int> n;
  std::vector<std::pair<double, std::string>> order, sorted;
  for (const TrialPlan& plan : plans(block, 7)) {
    EXPECT_EQ(plan.masses_g.at(static_cast<std::size_t>(*plan.reference_slot - 1)),
              *plan.reference_g);
    EXPECT_NEAR(comparison_g(plan), *plan.reference_g + *plan.level_g, 1e-9);
    ++n[{*plan.reference_g, plan.condition}];
    order.emplace_back(*plan.reference_g, plan.condition);
  }
  EXPECT_EQ(n,
            (decltype(n){{{100, "C2"}, 3}, {{100, "C1"}, 1}, {{200, "C2"}, 3}, {{200, "C1"}, 1}}));
  sorted = order;
  std::ranges::sort(sorted);
  EXPECT_NE(order, sorted);
  EXPECT_EQ(block.expected_trials(), 8);
}

TEST(AdjustmentRun, DrawsFirstMassesUniformlyAndTheSameForEachAttempt) {
  const Adjustment::Block block = block_of({100}, 400);
  const auto first = plans(block, 7), again = plans(block, 7, 2);
  double sum_g = 0;
  std::set<double> masses;
  int n_left = 0, n_moved = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    const double start_g = comparison_g(first[i]);
    EXPECT_THAT(start_g, AllOf(Ge(50), Le(500)));
    EXPECT_EQ(start_g, comparison_g(again[i]));
    masses.insert(start_g);
    sum_g += start_g;
    if (first[i].reference_slot == 1) ++n_left;
    if (first[i].reference_slot != again[i].reference_slot) ++n_moved;
  }
  // Of 400: the mean's standard error is 6.5 g, that of a number of sides 10.
  EXPECT_NEAR(sum_g / 400, 275, 26);
  EXPECT_NEAR(n_left, 200, 40);
  EXPECT_NEAR(n_moved, 200, 40);
  EXPECT_GT(masses.size(), 390u);
  EXPECT_LT(*masses.begin(), 60);
  EXPECT_GT(*masses.rbegin(), 490);
}

// A trial with the comparison in slot 2.
Adjustment::Trial trial_at(const Adjustment::Block& block, double reference_g, double start_g) {
  TrialPlan plan = TrialKey{1, 1, 1}.plan(block.name, "adjustment", "C2");
  plan.reference_g = reference_g;
  plan.level_g = start_g - reference_g;
  plan.reference_slot = 1;
  plan.masses_g = {reference_g, start_g};
  return {block, plan, 1};
}
Action step(double change_g, int slot = 2) {
  return {"adjust", slot, {}, change_g};
}

TEST(AdjustmentTrial, StepsChangeTheComparisonAndTheConfirmedMassIsItsValue) {
  Adjustment::Trial trial = trial_at(block_of({200}), 200, 300.5);
  for (const double change_g : {-50.0, -50.0, 10.0}) {
    ASSERT_FALSE(trial.refusal(step(change_g)));
    EXPECT_FALSE(trial.ends(step(change_g)));
    trial.take(step(change_g));
  }
  EXPECT_THAT(trial.plan().masses_g, ElementsAre(200, 210.5));
  EXPECT_EQ(trial.plan().n_reshuffles, 3) << "the cubes are placed again with each step";
  EXPECT_EQ(trial.plan().level_g, 100.5) << "the level is that of the start";
  ASSERT_FALSE(trial.refusal({"equal"}));
  EXPECT_TRUE(trial.ends({"equal"}));
  trial.take({"equal"});
  EXPECT_EQ(trial.result().value, 210.5);
  EXPECT_EQ(trial.result().outcome, "adjusted");
  EXPECT_EQ(trial.answer(), "210.5");
  EXPECT_FALSE(trial.n_answers()) << "a number";
}

TEST(AdjustmentTrial, RefusesTheReferenceOtherStepsAndMassesBeyondTheLimits) {
  const Adjustment::Block block = block_of({200});
  Adjustment::Trial trial = trial_at(block, 200, 60);
  EXPECT_THAT(*trial.refusal(step(10, 1)), HasSubstr("cube 1 is the reference"));
  EXPECT_THAT(*trial.refusal(step(20)), HasSubstr("20 g is none of the steps -50, -10, 10, 50 g"));
  EXPECT_FALSE(trial.refusal(step(-50))) << "down to the fine step";
  trial.take(step(-50));
  EXPECT_THAT(*trial.refusal(step(-10)), HasSubstr("the mass would be 0 g, outside 10 to 1000 g"));
  EXPECT_EQ(block.highest_g(), 1000) << "twice the heaviest first mass";
  EXPECT_TRUE(trial_at(block, 200, 960).refusal(step(50)));
  EXPECT_FALSE(trial_at(block, 200, 950).refusal(step(50)));
  EXPECT_EQ(block_of({700}).highest_g(), 1400) << "twice the reference";
}

Adjustment::Offer offer_of(const Adjustment::Trial& trial) {
  ScreenState screen;
  trial.show(screen);
  return std::any_cast<Adjustment::Offer>(screen.offer);
}

TEST(AdjustmentTrial, OffersWhichStepsArePossibleAndHowOftenTheyTurned) {
  Adjustment::Trial trial = trial_at(block_of({200}), 200, 40);
  std::vector<double> changes_g;
  std::vector<bool> possible;
  for (const Adjustment::Step& one : offer_of(trial).steps) {
    changes_g.push_back(one.change_g);
    possible.push_back(one.is_possible);
  }
  EXPECT_THAT(changes_g, ElementsAre(-50, -10, 10, 50));
  EXPECT_THAT(possible, ElementsAre(false, true, true, true));
  EXPECT_EQ(offer_of(trial).slot, 2);
  for (const double change_g : {50.0, 50.0, -10.0, -10.0, 10.0}) trial.take(step(change_g));
  EXPECT_EQ(offer_of(trial).n_turns, 2);
  TrialPlan mirrored = trial.plan();
  mirrored.reference_slot = 2;
  EXPECT_EQ(offer_of({block_of({200}), mirrored, 1}).slot, 1);
}

TEST(AdjustmentTrial, MassesAreWholeMilligramsAfterAnyStep) {
  Adjustment::Block block = block_of({100});
  block.steps_g = {0.3, 0.1};
  Adjustment::Trial trial = trial_at(block, 100, 100);
  for (int i = 0; i < 1000; ++i) trial.take(step(0.1));
  for (int i = 0; i < 1000; ++i) trial.take(step(-0.1));
  EXPECT_EQ(trial.plan().masses_g[1], 100);
}

TEST(AdjustmentBlock, KeysAreChecked) {
  const auto says = [](const Adjustment::Block& block) {
    std::string text;
    for (const ConfigMistake& mistake : block.check()) text += mistake.text() + "\n";
    return text;
  };
  EXPECT_THAT(says(block_of({100, 200})), IsEmpty());
  EXPECT_THAT(says(block_of({})), HasSubstr("reference_g has no masses"));
  EXPECT_THAT(says(block_of({100, 200, 100})), HasSubstr("reference_g has 100 g twice"));
  EXPECT_THAT(says(block_of({100}, 0)), HasSubstr("the block has 0 trials"));
  EXPECT_THAT(says(block_of({100}, 501)), HasSubstr("the block has 501 trials"));
  EXPECT_EQ(says(block_of({100}, 500)), "");
  const auto with_starts = [&](std::vector<double> start_g) {
    Adjustment::Block block = block_of({100});
    block.start_g = std::move(start_g);
    return says(block);
  };
  EXPECT_THAT(with_starts({50, 50}), IsEmpty()) << "a fixed first mass";
  for (const std::vector<double>& range : {std::vector<double>{50}, {500, 50}, {50, 100, 500}})
    EXPECT_THAT(with_starts(range), HasSubstr("start_g is ["));
  EXPECT_THAT(with_starts({5, 500}), HasSubstr("the fine step is 10 g, expected at most 5 g"));
  const auto with_steps = [&](std::vector<double> steps_g) {
    Adjustment::Block block = block_of({100});
    block.steps_g = std::move(steps_g);
    return says(block);
  };
  for (const std::vector<double>& steps : {std::vector<double>{}, {10, 50}, {10, 10}, {50, 10, 5}})
    EXPECT_THAT(with_steps(steps), HasSubstr("steps_g is ["));
  EXPECT_THAT(with_steps({200, 150}), HasSubstr("the fine step is 150 g, expected at most 50 g"));
}

Action simulated(const Adjustment::Trial& trial, double reference_mm, double comparison_mm,
                 bool differ) {
  RandomStream stream(1, "answer");
  const Percepts percepts{.remembered_mm = {reference_mm, comparison_mm}, .differ = differ};
  return Adjustment::simulated(offer_of(trial), percepts, stream).actions.at(0);
}

TEST(Adjustment, SimulatedParticipantsStepUntilTheirPerceptsDoNotDiffer) {
  Adjustment::Trial trial = trial_at(block_of({200}), 200, 300);
  EXPECT_EQ(simulated(trial, 30, 31, false).kind, "equal");
  EXPECT_EQ(simulated(trial, 30, 40, true), step(-50)) << "the comparison is heavier";
  EXPECT_EQ(simulated(trial, 40, 30, true), step(50));
  trial.take(step(-50));
  EXPECT_EQ(simulated(trial, 40, 30, true), step(50)) << "coarse until the direction has changed";
  trial.take(step(50));
  EXPECT_EQ(simulated(trial, 40, 30, true), step(10));
  Adjustment::Trial lightest = trial_at(block_of({200}), 200, 30);
  EXPECT_EQ(simulated(lightest, 1, 2, true), step(-10)) << "the coarse step is not possible";
  lightest.take(step(-10));
  lightest.take(step(-10));
  EXPECT_EQ(simulated(lightest, 1, 2, true).kind, "equal") << "no step is";
}

// 195 and 205 g differ from 200 g, and no step between them is possible.
TEST(Adjustment, SimulatedParticipantsConfirmWhereStepsSkipTheEqualMass) {
  Adjustment::Trial trial = trial_at(block_of({200}), 200, 305);
  int n_steps = 0;
  for (;; ++n_steps) {
    ASSERT_LT(n_steps, 20);
    const double set_g = trial.plan().masses_g[1];
    const Action action = simulated(trial, 200, set_g, std::abs(set_g - 200) > 4);
    trial.take(action);
    if (trial.ends(action)) break;
  }
  EXPECT_NEAR(*trial.result().value, 200, 5 + 1e-9);
}

TEST(Adjustment, LapsesAreAnyPossibleActionAndBlindAnswersConfirm) {
  const Adjustment::Trial trial = trial_at(block_of({200}), 200, 40);  // without the step of -50 g
  RandomStream stream(3, "answer");
  std::map<double, int> n;
  const Percepts percepts{.remembered_mm = {0.2, 0.7}, .lapse = true};
  for (int i = 0; i < 4000; ++i)
    ++n[Adjustment::simulated(offer_of(trial), percepts, stream).actions.at(0).value.value_or(0)];
  ASSERT_EQ(n.size(), 4u);
  for (const auto& [change_g, times] : n) EXPECT_NEAR(times, 1000, 110) << change_g;
  EXPECT_EQ(Adjustment::blind({}, {}, stream), (Answer{{{"equal"}}}));
}

// The example with one adjustment of each reference, from 300 g.
Protocol short_protocol() {
  std::string text = read_text_file(source_folder() + "/protocols/examples/adjustment.toml");
  for (const auto& [was, is] :
       {std::pair("[50, 500]", "[300, 300]"), std::pair("trials = 3 ", "trials = 1 ")})
    text.replace(text.find(was), std::string_view(was).size(), is);
  return parse_protocol(text, "short.toml");
}

// The log has every step; the cubes, what is displayed and what is replayed follow them.
TEST(AdjustmentSession, ValueIsTheStartAndTheSumOfLoggedStepsAndTheLagFollowsThem) {
  const StoredSession stored(short_protocol(), "ideal", 5);
  const LogReader& reader = stored.reader();
  EXPECT_FALSE(verify_session(reader, stored.id(), [](double) {}).first);
  int n_trials = 0;
  for (const TrialRow& trial : reader.trials(stored.id())) {
    if (trial.plan.task != "adjustment") continue;
    double set_g = *trial.plan.reference_g + *trial.plan.level_g;
    EXPECT_EQ(set_g, 300);
    int n_steps = 0;
    for (const AnswerRow& answer : reader.answers(stored.id())) {
      if (answer.attempt_index != trial.attempt_index || answer.action != "adjust") continue;
      set_g += *answer.value;
      ++n_steps;
    }
    EXPECT_GE(n_steps, 2);
    EXPECT_EQ(trial.plan.n_reshuffles, n_steps);
    EXPECT_DOUBLE_EQ(*trial.value, set_g);
    EXPECT_NEAR(set_g, *trial.plan.reference_g, 15) << "an ideal observer";
    for (const CubeRow& cube : reader.cubes(stored.id()))
      if (cube.attempt_index == trial.attempt_index) {
        EXPECT_DOUBLE_EQ(cube.mass_g, cube.slot == trial.plan.reference_slot
                                          ? *trial.plan.reference_g
                                          : *trial.value);
        EXPECT_GE(cube.n_pushes, 1) << "since the last step";
        // Friction 0.8 times gravity over 50 N/m, and a few mm before the cube slides.
        const double beyond_mm = 1e3 * *cube.peak_lag_m - 0.157 * cube.mass_g;
        EXPECT_GT(beyond_mm, -1);
        EXPECT_LT(beyond_mm, 7);
      }
    ++n_trials;
  }
  EXPECT_EQ(n_trials, 2);
}

}  // namespace
}  // namespace heft
