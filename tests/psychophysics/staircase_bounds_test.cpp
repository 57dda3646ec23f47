// Hand-computed staircases: floors, ceilings and reversals at bounds.
#include <gmock/gmock.h>

#include "psychophysics/Staircases.h"
#include "psychophysics/UpDown.h"

namespace heft {
namespace {

using test::answer;
using test::fixed_step;
using test::paper_15g;
using test::Trace;
using testing::ElementsAre;
using testing::IsEmpty;

TEST(UpDown, ClampsAtTheFloorAndCountsIt) {
  UpDown staircase(paper_15g());
  EXPECT_THAT(answer(staircase, "+++++-").levels, ElementsAre(175, 125, 75, 25, 0, 0, 50));
  EXPECT_EQ(staircase.n_floor(), 2);
  EXPECT_EQ(staircase.n_ceiling(), 0);
}

TEST(UpDown, ReachingTheFloorExactlyIsNotCutShort) {
  UpDownConfig config = paper_15g();
  config.start = 150;
  config.bound_is_reversal = true;
  UpDown staircase(config);
  const Trace trace = answer(staircase, "+++");
  EXPECT_EQ(trace.levels.back(), 0);
  EXPECT_EQ(staircase.n_floor(), 0);
  EXPECT_THAT(trace.reversal_trials, IsEmpty());
}

// In binary .3 - .1 - .1 - .1 is 2.8e-17, and -.3 + .1 + .1 + .1 is -2.8e-17.
TEST(UpDown, ReachesZeroExactlyWhereOnlyRoundingIsBetween) {
  for (const bool down : {true, false}) {
    UpDown staircase(down ? UpDownConfig{.start = 0.3, .step = 0.1, .floor = 0}
                          : UpDownConfig{.start = -0.3, .step = 0.1, .ceiling = 0});
    for (int i = 0; i < 3; ++i) staircase.respond(down);
    EXPECT_EQ(staircase.level(), 0);
    EXPECT_EQ(staircase.n_floor() + staircase.n_ceiling(), 0) << "reached, not cut short";
    staircase.respond(down);
    EXPECT_EQ(staircase.level(), 0);
    EXPECT_EQ(staircase.n_floor() + staircase.n_ceiling(), 1);
  }
}

TEST(UpDown, ClampsAtTheCeiling) {
  UpDownConfig config = fixed_step(10, 4);
  config.ceiling = 15;
  UpDown staircase(config);
  EXPECT_THAT(answer(staircase, "---+").levels, ElementsAre(10, 14, 15, 15, 11));
  EXPECT_EQ(staircase.n_ceiling(), 2);
}

TEST(UpDown, AMoveCutShortStillTurns) {
  UpDownConfig config = fixed_step(1, 4);
  config.floor = 0;
  const Trace trace = answer(config, "-+++-");
  EXPECT_THAT(trace.levels, ElementsAre(1, 5, 1, 0, 0, 4));
  EXPECT_THAT(trace.reversal_trials, ElementsAre(2, 5));
  EXPECT_THAT(trace.reversal_levels, ElementsAre(5, 0));
}

TEST(UpDown, VirtualLevelContinuesBeyondTheBound) {
  UpDownConfig config = fixed_step(10, 4);
  config.floor = 5;
  config.at_bound = AtBound::virtual_level;
  UpDown staircase(config);  // planned 10 6 2 -2 2 6
  const Trace trace = answer(staircase, "+++--");
  EXPECT_THAT(trace.levels, ElementsAre(10, 6, 5, 5, 5, 6));
  EXPECT_THAT(trace.reversal_levels, ElementsAre(5));
  EXPECT_EQ(staircase.n_floor(), 2);
}

TEST(UpDown, AlwaysYesAtTheFloorEndsByTrials) {
  UpDown staircase(paper_15g());
  answer(staircase, std::string(500, '+'));
  EXPECT_EQ(staircase.finish(), StopReason::trials);
  EXPECT_EQ(staircase.n_trials(), 200);
  EXPECT_EQ(staircase.estimate(), std::nullopt);
}

TEST(UpDown, AlwaysYesEndsByReversalsWhereABoundIsOne) {
  UpDownConfig config = paper_15g();
  config.bound_is_reversal = true;
  UpDown staircase(config);  // 175 125 75 25, then the floor cuts every move short
  const Trace trace = answer(staircase, std::string(500, '+'));
  EXPECT_EQ(staircase.finish(), StopReason::reversals);
  EXPECT_THAT(trace.reversal_trials, ElementsAre(4, 5, 6, 7, 8, 9, 10, 11, 12, 13));
  EXPECT_THAT(trace.reversal_levels, ElementsAre(25, 0, 0, 0, 0, 0, 0, 0, 0, 0));
  EXPECT_EQ(staircase.estimate(), 0);
}

TEST(UpDown, OneAnswerMakesOneReversal) {
  UpDownConfig config = fixed_step(1, 4);
  config.floor = 0;
  config.ceiling = 3;
  config.bound_is_reversal = true;  // every move is cut short, and most of them turn as well
  EXPECT_THAT(answer(config, "-+-++").reversal_trials, ElementsAre(1, 2, 3, 4, 5));
}

// Trial 2 would pass the floor with the current step, 8; the resulting reversal halves the step.
TEST(UpDown, BoundIsJudgedByTheStepWithoutItsReversal) {
  UpDownConfig config = fixed_step(14, 8);
  config.halve_every = 1;
  config.floor = 0;
  config.bound_is_reversal = true;
  UpDown staircase(config);
  EXPECT_THAT(answer(staircase, "++-").levels, ElementsAre(14, 6, 0, 2));
  EXPECT_EQ(staircase.reversals()[0].step_before, 8);
  EXPECT_EQ(staircase.reversals()[0].step_after, 4);
}

TEST(UpDown, LevelsAndEstimateStayFinite) {
  UpDownConfig config = fixed_step(1, 200);
  config.step_scale = StepScale::db;
  config.discard_reversals = 0;
  config.stop_reversals = 20;
  UpDown staircase(config);
  for (double level : answer(staircase, std::string(100, '-')).levels)
    EXPECT_LE(level, largest_level);
  for (int i = 0; !staircase.finished(); ++i) staircase.respond(i % 2 == 0, largest_level);
  EXPECT_NEAR(*staircase.estimate(), largest_level, 1e285);
}

}  // namespace
}  // namespace heft
