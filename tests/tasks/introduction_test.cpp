// Introduction: asks until the heavier cube is chosen.
#include "tasks/Introduction.h"

#include <gmock/gmock.h>

namespace heft {
namespace {

TEST(IntroductionTrial, AsksAgainUntilHeavierCubeIsChosen) {
  for (const WrongAnswer rule : {WrongAnswer::same_layout, WrongAnswer::reshuffle}) {
    Introduction::Block block;
    block.masses_g = {15, 800};
    block.wrong_answer = rule;
    Introduction::Run run(block, 7);
    Introduction::Trial trial(block, run.plan({7, 1, 1}), 7);
    for (int n_wrong = 0; n_wrong < 3; ++n_wrong) {
      const int light = trial.plan().masses_g[0] == 15 ? 1 : 2;
      ScreenState screen;
      trial.show(screen);
      EXPECT_EQ(screen.try_again, n_wrong > 0);
      EXPECT_FALSE(trial.ends({"select", light}));
      EXPECT_TRUE(trial.ends({"select", 3 - light}));
      trial.take({"select", light});
      EXPECT_FALSE(trial.result().outcome);
      EXPECT_EQ(trial.answer(), "other");
      EXPECT_EQ(trial.plan().n_reshuffles, rule == WrongAnswer::reshuffle ? n_wrong + 1 : 0);
    }
    trial.take({"select", trial.plan().masses_g[0] == 800 ? 1 : 2});
    EXPECT_EQ(trial.result().outcome, "correct");
    EXPECT_EQ(trial.result().choice_correct, true);
    EXPECT_EQ(trial.answer(), "heaviest");
  }
}

TEST(IntroductionRun, IsOneTrial) {
  Introduction::Block block;
  block.masses_g = {15, 800};
  Introduction::Run run(block, 7);
  EXPECT_FALSE(run.finished());
  EXPECT_THAT(run.plan({7, 1, 1}).masses_g, ::testing::UnorderedElementsAre(15, 800));
  Changes changes;
  run.complete({}, changes);
  EXPECT_TRUE(run.finished());
}

TEST(HeaviestSlot, IgnoresLastWrongChoices) {
  const std::vector<double> values{1, 3, 2};
  const std::vector<int> wrong{2}, all{1, 2, 3};
  EXPECT_EQ(heaviest_slot(values, {}), 2);
  EXPECT_EQ(heaviest_slot(values, wrong), 3);
  EXPECT_EQ(heaviest_slot(values, all), 1) << "shuffled since";
}

}  // namespace
}  // namespace heft
