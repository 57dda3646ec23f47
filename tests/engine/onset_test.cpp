// When a trial may start and be answered, by the setup.
#include <gmock/gmock.h>

#include "engine/Engine.h"
#include "engine/Plans.h"

namespace heft {
namespace {

using ::testing::HasSubstr;
using testing::shared;
using testing::small_plan;

constexpr double gap_s = 0.6, min_answer_s = 0.5;

class OnsetRules : public ::testing::Test {
 protected:
  OnsetRules() { told(gap_s, min_answer_s); }

  void told(std::optional<double> gap, std::optional<double> min_answer) {
    SessionConfig setup;
    setup.gap_s = gap;
    setup.min_answer_s = min_answer;
    engine.apply({t_s, setup});
  }
  void at(double event_s, EventPayload what) { engine.apply({t_s = event_s, std::move(what)}); }
  std::string refusal(double event_s, EventPayload what) const {
    return engine.admit({event_s, std::move(what)}).refusal;
  }
  // The introduction's trial, from its start to the correct answer.
  double introduce(double start_s, double answer_s) {
    at(start_s, TrialStarted{});
    at(start_s, CubesShown{});
    const auto& masses_g = engine.next().plan->masses_g;
    at(answer_s, Action{"select", masses_g[0] > masses_g[1] ? 1 : 2});
    return answer_s;
  }

  Engine engine{[] {
                  SessionPlan session_plan = small_plan();
                  session_plan.blocks.erase(session_plan.blocks.begin());  // its demonstration
                  return shared(session_plan);
                }(),
                7};
  double t_s = 0;
};

const Action dont_know{"dont_know"};

TEST_F(OnsetRules, TrialStartsAfterGap) {
  EXPECT_EQ(engine.trial_due_s(), 0) << "none before the first";
  const double ended_s = introduce(1, 4);
  EXPECT_THAT(refusal(ended_s + gap_s - 0.001, TrialStarted{}), HasSubstr("gap"));
  EXPECT_EQ(refusal(ended_s + gap_s + 0.001, TrialStarted{}), "");
  EXPECT_EQ(refusal(engine.trial_due_s(), TrialStarted{}), "");
}

TEST_F(OnsetRules, VoidedTrialIsFollowedByGap) {
  at(1, TrialStarted{});
  at(2, TrialVoided{"veto: door"});
  EXPECT_THAT(refusal(2.5, TrialStarted{}), HasSubstr("gap"));
}

TEST_F(OnsetRules, EarlyAnswerIsRefused) {
  at(1, TrialStarted{});
  EXPECT_FALSE(engine.screen().answers_from_s) << "no cubes are there yet";
  const double shown_s = t_s + 2;
  at(shown_s, CubesShown{});
  EXPECT_THAT(refusal(shown_s + 0.499, Action{"select", 1}), HasSubstr("earlier than 0.5 s"));
  EXPECT_EQ(refusal(shown_s + 0.501, Action{"select", 1}), "");
  const ScreenState screen = engine.screen();
  EXPECT_TRUE(screen.can_answer) << "the buttons are live with the cubes";
  EXPECT_NEAR(screen.answers_from_s.value(), 2.5, 1e-6) << "since the trial's start";
  EXPECT_EQ(refusal(1 + *screen.answers_from_s, Action{"select", 1}), "");
}

TEST_F(OnsetRules, EarlyLabelIsRefused) {
  introduce(1, 4);
  at(5, TrialStarted{});
  at(5, CubesShown{});
  EXPECT_THAT(refusal(5.4, Action{"label", 1, "lightest"}), HasSubstr("earlier than"));
  EXPECT_THAT(refusal(5.4, dont_know), HasSubstr("earlier than"));
  EXPECT_EQ(refusal(5.6, dont_know), "");
}

TEST_F(OnsetRules, RecordedRefusalChangesNothing) {
  at(1, TrialStarted{});
  at(1, CubesShown{});
  const ScreenState before = engine.screen();
  const Changes changes = engine.apply({1.2, ActionRefused{{"select", 1}, "it comes too early"}});
  EXPECT_FALSE(changes.trial);
  EXPECT_TRUE(changes.answers.empty());
  EXPECT_EQ(changes.attempt_index, 1) << "but it is known which trial it was meant for";
  EXPECT_EQ(engine.screen().n_choices, before.n_choices);
}

TEST_F(OnsetRules, SetupWithoutLimitsHasNone) {
  told(std::nullopt, std::nullopt);
  const double ended_s = introduce(1, 1);
  EXPECT_EQ(refusal(ended_s, TrialStarted{}), "");
  EXPECT_FALSE(engine.screen().answers_from_s);
}

TEST_F(OnsetRules, ScreenBetweenTrialsIsNextTrialWithoutCubes) {
  introduce(1, 4);
  const ScreenState screen = engine.screen();
  EXPECT_EQ(screen.screen, Screen::trial);
  EXPECT_EQ(screen.task, "sorting");
  EXPECT_EQ(screen.trial_number, 2);
  EXPECT_FALSE(screen.can_answer);
  at(5, TrialStarted{});
  EXPECT_EQ(engine.screen().page(), screen.page()) << "no page turns when it starts";
  EXPECT_TRUE(engine.screen_with_cubes().can_answer);
  EXPECT_FALSE(engine.screen().can_answer);
}

TEST_F(OnsetRules, TakenBreakIsNotRepeated) {
  introduce(1, 4);
  while (engine.next().plan->task == "sorting") {
    at(std::max(t_s, engine.trial_due_s()), TrialStarted{});
    at(t_s, CubesShown{});
    at(t_s + 1, dont_know);
  }
  ASSERT_TRUE(engine.next().rest);
  at(t_s + 1, BreakTaken{"another", 1});
  EXPECT_TRUE(engine.next().rest) << "it was not this one";
  at(t_s + 60, BreakTaken{engine.next().rest->name, 60});
  EXPECT_FALSE(engine.next().rest);
}

}  // namespace
}  // namespace heft
