#include <gtest/gtest.h>

#include "EditedFile.h"
#include "protocol/Protocol.h"
#include "psychophysics/ProcedureKinds.h"
#include "tasks/Tasks.h"

namespace heft {
namespace {

// The paper's staircases take 19 to 21 trials each.
TEST(ExpectedLength, OfThePapersStaircases) {
  const Protocol paper = load_protocol(shipped_path("paper"));
  const TrialsByTask trials = expected_trials(paper);
  EXPECT_GE(trials.at("comparison") / 3, 19);
  EXPECT_LE(trials.at("comparison") / 3, 21);
  EXPECT_DOUBLE_EQ(total_of(trials), trials.at("comparison") + 11);
  EXPECT_TRUE(depends_on_answers(paper));
}

TEST(ExpectedLength, AddsUpBlocks) {
  Protocol protocol;
  protocol.blocks = {DemonstrationBlock{"d", 30}, Introduction::Block{}, Sorting::Block{},
                     BreakBlock{"b", 60}};
  const TrialsByTask trials = expected_trials(protocol);
  EXPECT_EQ(trials, (TrialsByTask{{"introduction", 1}, {"sorting", 10}}));
  EXPECT_DOUBLE_EQ(expected_minutes(protocol, trials), (30 + 15.6 + 10 * 25.6 + 60) / 60.0);
  EXPECT_FALSE(depends_on_answers(protocol));
}

TEST(ExpectedLength, UsesTheTrialDurationOfEachTask) {
  Protocol protocol;
  protocol.onset.gap_s = 0;
  Tasks::each([&]<typename Kind>() {
    const std::string name(Kind::task.name);
    EXPECT_DOUBLE_EQ(expected_minutes(protocol, {{name, 60}}), Kind::task.trial_s) << name;
  });
}

TEST(ExpectedLength, CountsCatchTrials) {
  Protocol protocol = load_protocol(shipped_path("jnd"));
  protocol.blocks = {protocol.blocks.back()};
  const double without = total_of(expected_trials(protocol));
  block_as<Comparison::Block>(protocol.blocks.back())->catch_fraction = 0.2;
  EXPECT_NEAR(total_of(expected_trials(protocol)), without / 0.8, 1e-9);
}

TEST(ExpectedLength, IsLimitedForAnEndlessStaircase) {
  Comparison::Block block;
  block.staircases = {
      {1, {"long", UpDownConfig{.start = 1e6, .step = 1e-6, .stop_trials = 2'000'000'000}}, {}}};
  Protocol protocol;
  protocol.blocks = {block};
  EXPECT_LE(total_of(expected_trials(protocol)), 1000);
}

TEST(ExpectedLength, IsTheLargestOfABayesianKind) {
  Comparison::Block block;
  QuestConfig quest{.guess = 100, .guess_sd = 80, .beta = 0.02, .grain = 1};
  quest.stop_trials = 70;
  quest.stop_ci_width = 40;
  block.staircases = {{200, {"quest", quest}, {}}};
  Protocol protocol;
  protocol.blocks = {block};
  EXPECT_EQ(total_of(expected_trials(protocol)), 70);
  EXPECT_TRUE(depends_on_answers(protocol));
}

TEST(ExpectedLength, CountsTheTrialsOfConstantStimuli) {
  Comparison::Block block;
  block.staircases = {{15, {"constant", ConstantConfig{.levels = {10, 20, 40}, .n_per_level = 12}}},
                      {200, {"other", ConstantConfig{.levels = {10}, .n_per_level = 4}}}};
  Protocol protocol;
  protocol.blocks = {block};
  EXPECT_EQ(total_of(expected_trials(protocol)), 40);
  EXPECT_FALSE(depends_on_answers(protocol));
}

TEST(ExpectedLength, OfTheQuickProtocolIsAboutTwoMinutes) {
  const Protocol quick = load_protocol(shipped_path("quick"));
  EXPECT_NEAR(expected_minutes(quick, expected_trials(quick)), 2, 0.5);
}

}  // namespace
}  // namespace heft
