// Hand-computed staircases: moves, steps and reversals.
#include <gmock/gmock.h>

#include <cmath>

#include "psychophysics/Staircases.h"
#include "psychophysics/UpDown.h"

namespace heft {
namespace {

using test::answer;
using test::fixed_step;
using test::listed_steps;
using test::paper_15g;
using test::Trace;
using testing::ElementsAre;
using testing::IsEmpty;

TEST(UpDown, StartsAtStart) {
  const UpDown staircase(paper_15g());
  EXPECT_EQ(staircase.level(), 175);
  EXPECT_EQ(staircase.n_trials(), 0);
  EXPECT_FALSE(staircase.finished());
  EXPECT_EQ(staircase.estimate(), std::nullopt);
}

// Steps 50 50 25 25 12.5 12.5 6.25 6.25 3.125 3.125 after 0, 1, 2... reversals.
TEST(UpDown, PapersRuleByHand) {
  UpDown staircase(paper_15g());
  const Trace trace = answer(staircase, "++-+-+-+--+-");
  EXPECT_THAT(trace.levels, ElementsAre(175, 125, 75, 125, 100, 125, 112.5, 125, 118.75, 125,
                                        131.25, 128.125, 131.25));
  EXPECT_THAT(trace.reversal_trials, ElementsAre(3, 4, 5, 6, 7, 8, 9, 11, 12));
  EXPECT_THAT(trace.reversal_levels,
              ElementsAre(75, 125, 100, 125, 112.5, 125, 118.75, 131.25, 128.125));
}

TEST(UpDown, StepAfterTheMoveLagsByOneMove) {
  UpDownConfig config = paper_15g();
  config.change_step = ChangeStep::after_move;
  EXPECT_THAT(answer(config, "++-+-+-").levels, ElementsAre(175, 125, 75, 125, 75, 100, 75, 87.5));
}

TEST(UpDown, ReversalNamesTheStepsBeforeAndAfter) {
  UpDown staircase(paper_15g());
  EXPECT_FALSE(staircase.respond(true).reversal);
  EXPECT_EQ(staircase.respond(false).reversal->step_after, 50);
  const auto second = staircase.respond(true).reversal;
  EXPECT_EQ(second->number, 2);
  EXPECT_EQ(second->step_before, 50);
  EXPECT_EQ(second->step_after, 25);
}

TEST(UpDown, FirstDueMoveIsNoReversalInEitherDirection) {
  EXPECT_THAT(answer(fixed_step(10, 1), "---").reversal_trials, IsEmpty());
  EXPECT_THAT(answer(fixed_step(10, 1), "+++").reversal_trials, IsEmpty());
}

TEST(UpDown, ListOfStepsRepeatsItsLast) {
  EXPECT_THAT(answer(listed_steps(100, {8, 4, 1}), "+-+-+-").levels,
              ElementsAre(100, 92, 96, 95, 96, 95, 96));
}

TEST(UpDown, HalvedStepsStopAtTheSmallest) {
  UpDownConfig config = fixed_step(100, 8);
  config.halve_every = 1;
  config.min_step = 3;
  EXPECT_THAT(answer(config, "+-+-+").levels, ElementsAre(100, 92, 96, 93, 96, 93));
}

TEST(UpDown, StepsWithoutHalvingStay) {
  EXPECT_THAT(answer(fixed_step(10, 2), "+-+-+").levels, ElementsAre(10, 8, 10, 8, 10, 8));
}

TEST(UpDown, OwnStepsUpwards) {
  UpDownConfig config = listed_steps(100, {4, 2});
  config.steps_up = {12, 6, 3};
  UpDown staircase(config);
  EXPECT_THAT(answer(staircase, "+-+-").levels, ElementsAre(100, 96, 102, 100, 103));
  EXPECT_EQ(staircase.reversals()[0].step_before, 12);  // a reversal upwards: steps upwards
  EXPECT_EQ(staircase.reversals()[0].step_after, 6);
  EXPECT_EQ(staircase.reversals()[1].step_before, 2);
}

TEST(UpDown, DecibelAndLogStepsMultiply) {
  UpDownConfig config = fixed_step(1, 20);
  config.step_scale = StepScale::db;
  EXPECT_THAT(answer(config, "-+").levels, ElementsAre(1, 10, 1));
  config.step = 2;
  config.step_scale = StepScale::log10;
  EXPECT_THAT(answer(config, "--+").levels, ElementsAre(1, 100, 10000, 100));
  config.step = 0.3;
  const double factor = std::pow(10.0, 0.3);
  EXPECT_THAT(answer(config, "+").levels, ElementsAre(1, 1 / factor));
}

TEST(UpDown, TwoDownOneUpCountsAnswersInARow) {
  UpDownConfig config = fixed_step(10, 1);
  config.down = 2;
  const Trace trace = answer(config, "+++-+-++");
  EXPECT_THAT(trace.levels, ElementsAre(10, 10, 9, 9, 10, 10, 11, 11, 10));
  EXPECT_THAT(trace.reversal_trials, ElementsAre(4, 8));
  EXPECT_THAT(trace.reversal_levels, ElementsAre(9, 11));
}

TEST(UpDown, OppositeAnswerStartsTheOtherCountAgain) {
  UpDownConfig config = fixed_step(10, 1);
  config.down = 3;
  config.up = 2;
  EXPECT_THAT(answer(config, "++-++-+++--").levels,
              ElementsAre(10, 10, 10, 10, 10, 10, 10, 10, 10, 9, 9, 10));
}

TEST(UpDown, InitialRuleMovesOnEveryAnswerUpToTheFirstReversal) {
  UpDownConfig config = fixed_step(10, 1);
  config.down = 3;
  config.initial_1up1down = true;
  const Trace trace = answer(config, "++-+++-");
  EXPECT_THAT(trace.levels, ElementsAre(10, 9, 8, 9, 9, 9, 8, 9));
  EXPECT_THAT(trace.reversal_trials, ElementsAre(3, 6, 7));
}

TEST(UpDown, InitialRuleEndsWithAReversalDownwardsToo) {
  UpDownConfig config = fixed_step(10, 1);
  config.down = 2;
  config.initial_1up1down = true;
  EXPECT_THAT(answer(config, "--+++").levels, ElementsAre(10, 11, 12, 11, 11, 10));
}

TEST(UpDown, ShownLevelIsTheReversalsValueAndPlansContinue) {
  UpDown staircase(paper_15g());
  staircase.respond(true, 180);
  EXPECT_EQ(staircase.level(), 125);
  const Update update = staircase.respond(false, 124.5);
  EXPECT_EQ(update.reversal->level, 124.5);
  EXPECT_EQ(staircase.level(), 175);
}

TEST(UpDown, CopiesAreValues) {
  UpDown one(paper_15g());
  one.respond(true);
  UpDown other = one;
  other.respond(true);
  EXPECT_EQ(one.level(), 125);
  EXPECT_EQ(other.level(), 75);
}

}  // namespace
}  // namespace heft
