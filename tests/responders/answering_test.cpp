// The finger: taps at human intervals, only what the screen offers, and it notices the outcome.
#include "responders/decision/Answering.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "FakeWorld.h"
#include "tasks/Offers.h"

namespace heft {
namespace {
const Label lightest("lightest"), intermediate("intermediate"), heaviest("heaviest");

class AnsweringTest : public testing::Test {
 protected:
  explicit AnsweringTest(const Task& task = "sorting", int n_cubes = 3)
      : answering_(3, {1, 1, task, fake::row_of(n_cubes)}, 0.7) {
    screen_.screen = Screen::trial;
    screen_.task = task;
  }

  // Pictures up to a time, all with the same screen.
  std::vector<TimedAction> until(double end_s) {
    std::vector<TimedAction> actions;
    for (; t_s_ < end_s; t_s_ += 1 / 15.0) {
      DisplayedFrame frame;
      frame.t_s = t_s_;
      for (const TimedAction& action : answering_.see(frame, screen_)) {
        EXPECT_GE(action.t_s, t_s_);
        EXPECT_LT(action.t_s, t_s_ + 1 / 15.0);
        actions.push_back(action);
      }
    }
    return actions;
  }

  Answering answering_;
  ScreenState screen_;
  double t_s_ = 0;
};

class IntroductionTest : public AnsweringTest {
 protected:
  IntroductionTest() : AnsweringTest("introduction", 2) {}
};

TEST_F(AnsweringTest, ValidatesOnlyOnceTheScreenOffersIt) {
  answering_.give(labeling({heaviest, lightest, intermediate}), 1);
  const auto labels = until(4);
  ASSERT_EQ(labels.size(), 3u);
  EXPECT_EQ(labels.front().t_s, 1);
  for (std::size_t i = 1; i < 3; ++i) EXPECT_GE(labels[i].t_s - labels[i - 1].t_s, 0.3);
  screen_.can_validate = true;
  const auto validated = until(5);
  ASSERT_EQ(validated.size(), 1u);
  EXPECT_EQ(validated[0].kind, "validate");
  EXPECT_GE(validated[0].t_s - labels.back().t_s, 0.3);
}

TEST_F(AnsweringTest, CorrectsAFirstLabelSoThatTheLastWordStands) {
  answering_.give(labeling({heaviest, lightest, intermediate}, true), 0);
  const auto labels = until(6);
  ASSERT_EQ(labels.size(), 4u);
  EXPECT_EQ(labels[0].slot, labels[1].slot);
  EXPECT_NE(labels[0].label, labels[1].label);
  std::vector<std::optional<Label>> on_screen(3);
  for (const TimedAction& action : labels) {
    for (auto& label : on_screen)
      if (label == action.label) label.reset();
    on_screen[static_cast<std::size_t>(*action.slot - 1)] = action.label;
  }
  EXPECT_THAT(on_screen, testing::ElementsAre(heaviest, lightest, intermediate));
}

TEST_F(AnsweringTest, APauseTakesNoTapsAndKeepsTheirDistances) {
  answering_.give(labeling({heaviest, lightest, intermediate}), 1);
  screen_.screen = Screen::paused;
  EXPECT_TRUE(until(4).empty());
  screen_.screen = Screen::trial;
  const auto labels = until(6.5);
  ASSERT_EQ(labels.size(), 3u);
  EXPECT_NEAR(labels[0].t_s, 4, 0.07);
  for (std::size_t i = 1; i < 3; ++i) EXPECT_GE(labels[i].t_s - labels[i - 1].t_s, 0.3);
  EXPECT_FALSE(answering_.free());
}

TEST_F(AnsweringTest, GivesUpAfterThreeAnswersThatWereNotTaken) {
  for (int i = 0; i < 3; ++i) {
    EXPECT_FALSE(answering_.gave_up(t_s_));
    answering_.give({{{"dont_know"}}}, t_s_ + 0.5);
    const auto actions = until(t_s_ + 5);
    ASSERT_EQ(actions.size(), 1u);
    EXPECT_EQ(actions[0].kind, "dont_know");
    EXPECT_TRUE(answering_.free());
  }
  EXPECT_TRUE(answering_.gave_up(t_s_));
}

TEST_F(AnsweringTest, GivesUpWaitingForCubes) {
  EXPECT_FALSE(answering_.gave_up(59));
  EXPECT_TRUE(answering_.gave_up(61));
  DisplayedFrame frame;
  frame.cubes.resize(3);
  answering_.see(frame, screen_);
  EXPECT_FALSE(answering_.gave_up(61));
}

TEST_F(IntroductionTest, NoticesAWrongChoiceByTheScreenAlone) {
  answering_.give(choosing(2), 0.5);
  ASSERT_EQ(until(1).size(), 1u);
  EXPECT_FALSE(answering_.free());
  screen_.n_choices = 1;
  screen_.try_again = true;
  until(1.2);
  EXPECT_TRUE(answering_.free());
  EXPECT_THAT(answering_.wrong_slots(), testing::ElementsAre(2));
  // "Try again" after the previous choice must not affect the next one.
  answering_.give(choosing(1), 2);
  ASSERT_EQ(until(3).size(), 1u);
  EXPECT_FALSE(answering_.free());
}

}  // namespace
}  // namespace heft
