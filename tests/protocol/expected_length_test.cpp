#include <gtest/gtest.h>

#include "EditedFile.h"
#include "protocol/ExpectedLength.h"
#include "psychophysics/ProcedureKinds.h"
#include "tasks/Tasks.h"

namespace heft {
namespace {

// PROCEDURES: the paper's staircases take 19 to 21 trials each.
TEST(ExpectedLength, OfThePapersStaircases) {
  const ExpectedLength length = expected_length(load_protocol(shipped_path("paper")));
  EXPECT_EQ(length.staircases, 3);
  EXPECT_GE(length.staircase_trials / 3, 19);
  EXPECT_LE(length.staircase_trials / 3, 21);
  EXPECT_DOUBLE_EQ(length.trials, length.staircase_trials + 11);
}

TEST(ExpectedLength, AddsUpBlocks) {
  Protocol protocol;
  protocol.blocks = {DemonstrationBlock{"d", 30}, Introduction::Block{}, Sorting::Block{},
                     BreakBlock{"b", 60}};
  const ExpectedLength length =
      expected_length(protocol, {{"introduction", 12}, {"sorting", 20}, {"comparison", 5}});
  EXPECT_DOUBLE_EQ(length.trials, 11);
  EXPECT_DOUBLE_EQ(length.minutes, (30 + 12.6 + 10 * 20.6 + 60) / 60.0);
}

TEST(ExpectedLength, CountsCatchTrials) {
  Protocol protocol = load_protocol(shipped_path("jnd"));
  protocol.blocks = {protocol.blocks.back()};
  const double without = expected_length(protocol).trials;
  block_as<Comparison::Block>(protocol.blocks.back())->catch_fraction = 0.2;
  EXPECT_NEAR(expected_length(protocol).trials, without / 0.8, 1e-9);
}

TEST(ExpectedLength, EndsWhereAStaircaseGetsNowhere) {
  Comparison::Block block;
  block.staircases = {
      {1, {"long", UpDownConfig{.start = 1e6, .step = 1e-6, .stop_trials = 2'000'000'000}}, {}}};
  Protocol protocol;
  protocol.blocks = {block};
  EXPECT_LE(expected_length(protocol).trials, 1000);
}

TEST(ExpectedLength, CountsTheTrialsOfConstantStimuli) {
  Comparison::Block block;
  block.staircases = {{15, {"constant", ConstantConfig{.levels = {10, 20, 40}, .n_per_level = 12}}},
                      {200, {"other", ConstantConfig{.levels = {10}, .n_per_level = 4}}}};
  Protocol protocol;
  protocol.blocks = {block};
  const ExpectedLength length = expected_length(protocol);
  EXPECT_EQ(length.trials, 40);
  EXPECT_EQ(length.staircases, 2);
  EXPECT_EQ(length.staircase_trials, 40);
}

TEST(ExpectedLength, OfTheQuickProtocolIsAboutTwoMinutes) {
  EXPECT_NEAR(expected_length(load_protocol(shipped_path("quick"))).minutes, 2, 0.5);
}

}  // namespace
}  // namespace heft
