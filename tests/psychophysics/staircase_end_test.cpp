// Hand-computed staircases: stop rules and estimates.
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

TEST(UpDown, TenthReversalEndsWithoutAMove) {
  UpDown staircase(paper_15g());
  answer(staircase, "++-+-+-+--+-");
  EXPECT_EQ(staircase.level(), 131.25);
  const Update last = staircase.respond(true);
  ASSERT_TRUE(last.reversal);
  EXPECT_EQ(last.reversal->number, 10);
  EXPECT_EQ(last.reversal->level, 131.25);
  EXPECT_EQ(last.reversal->step_before, 3.125);
  EXPECT_EQ(last.reversal->step_after, 1.5625);
  EXPECT_EQ(last.finish, StopReason::reversals);
  EXPECT_EQ(staircase.level(), 131.25);
  EXPECT_EQ(staircase.n_trials(), 13);
  // (100 + 125 + 112.5 + 125 + 118.75 + 131.25 + 128.125 + 131.25) / 8
  EXPECT_EQ(staircase.estimate(), 121.484375);
}

TEST(UpDown, EndsAtTheTrialLimitAndSaysSo) {
  UpDownConfig config = fixed_step(10, 1);
  config.stop_trials = 4;
  config.discard_reversals = 0;
  UpDown staircase(config);
  answer(staircase, "+-+");
  EXPECT_FALSE(staircase.finished());
  EXPECT_EQ(staircase.respond(true).finish, StopReason::trials);
  EXPECT_EQ(staircase.estimate(), 9.5);  // reversals at 9 and 10
}

TEST(UpDown, BothLimitsAtOnceIsReversals) {
  UpDownConfig config = fixed_step(10, 1);
  config.stop_reversals = 2;
  config.stop_trials = 3;
  EXPECT_THAT(answer(config, "+-+").reversal_trials, ElementsAre(2, 3));
  UpDown staircase(config);
  answer(staircase, "+-+");
  EXPECT_EQ(staircase.finish(), StopReason::reversals);
}

TEST(UpDown, MinimumTrialsKeepItRunningAndReversalsContinue) {
  UpDownConfig config = fixed_step(10, 1);
  config.stop_reversals = 2;
  config.min_trials = 5;
  UpDown staircase(config);
  const Trace trace = answer(staircase, "+-+-++");
  EXPECT_THAT(trace.reversal_trials, ElementsAre(2, 3, 4, 5));
  EXPECT_EQ(staircase.n_trials(), 5);
  EXPECT_EQ(staircase.finish(), StopReason::reversals);
}

TEST(UpDown, LeastTrialsMayEndItOnAnAnswerWithoutReversal) {
  UpDownConfig config = fixed_step(10, 1);
  config.stop_reversals = 2;
  config.min_trials = 5;
  UpDown staircase(config);
  const Trace trace = answer(staircase, "+-++++");
  EXPECT_THAT(trace.levels, ElementsAre(10, 9, 10, 9, 8));  // no move after the fifth
  EXPECT_THAT(trace.reversal_trials, ElementsAre(2, 3));
  EXPECT_EQ(staircase.level(), 8);
  EXPECT_EQ(staircase.finish(), StopReason::reversals);
}

TEST(UpDown, EstimateNeedsMoreReversalsThanAreDiscarded) {
  UpDownConfig config = fixed_step(10, 1);
  config.discard_reversals = 2;
  config.stop_trials = 3;
  UpDown staircase(config);
  answer(staircase, "+-+");
  EXPECT_TRUE(staircase.finished());
  EXPECT_EQ(staircase.estimate(), std::nullopt);
}

}  // namespace
}  // namespace heft
