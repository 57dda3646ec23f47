// Vetoed answers: recorded, presented again, and without effect on procedures.
#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include "engine/Engine.h"
#include "engine/Plans.h"

namespace heft {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::shared;
using ::testing::SizeIs;

SessionPlan two_staircases() {
  SessionPlan session_plan = testing::small_plan();
  session_plan.blocks = {session_plan.blocks.back(), BreakBlock{"break", 1},
                         session_plan.blocks[2]};
  return session_plan;
}

struct Comparing {
  Changes apply(EventPayload what) { return engine.apply({++t_s, std::move(what)}); }
  std::string refusal(EventPayload what) { return engine.admit({t_s, std::move(what)}).refusal; }
  TrialPlan start() {
    apply(TrialStarted{});
    apply(CubesShown{});
    return *engine.next().plan;
  }
  Changes answer(bool yes) {
    start();
    return apply(yes ? Action{"select", 1} : Action{"no_difference"});
  }
  bool compares() const { return engine.next().plan && engine.next().plan->task == "comparison"; }

  Engine engine{shared(two_staircases()), 7};
  double t_s = 0;
};

const AnswerVetoed by_mistake{"tapped by mistake"};

TEST(VetoedAnswer, IsVoidAndTrialIsPresentedAgain) {
  Comparing session;
  session.answer(true);
  const TrialRow answered = *session.answer(true).trial;
  const Changes changes = session.apply(by_mistake);
  EXPECT_EQ(changes.attempt_index, answered.attempt_index);
  EXPECT_EQ(changes.trial->status, TrialStatus::voided);
  EXPECT_EQ(changes.trial->void_reason, "answer vetoed: tapped by mistake");
  EXPECT_FALSE(changes.trial->outcome) << "whoever counts outcomes does not count it";
  EXPECT_EQ(changes.trial->chosen_slot, answered.chosen_slot) << "what was answered stays";
  EXPECT_EQ(changes.trial->validated_s, answered.validated_s);
  EXPECT_EQ(session.engine.n_completed(), 1);
  const TrialPlan again = session.start();
  EXPECT_EQ(again.trial_number, answered.plan.trial_number);
  EXPECT_EQ(again.attempt, 2);
  EXPECT_EQ(again.staircase, answered.plan.staircase);
  EXPECT_EQ(again.level_g, answered.plan.level_g);
}

TEST(VetoedAnswer, IsAcceptedOnceBetweenTrials) {
  Comparing session;
  EXPECT_THAT(session.refusal(by_mistake), HasSubstr("no answer to veto"));
  session.answer(true);
  session.answer(false);
  session.start();
  EXPECT_THAT(session.refusal(by_mistake), HasSubstr("voided first"));
  session.apply(TrialVoided{std::string(void_interrupted)});
  EXPECT_THAT(session.refusal(AnswerVetoed{}), HasSubstr("reason"));
  session.apply(by_mistake);
  EXPECT_THAT(session.refusal(by_mistake), HasSubstr("no answer to veto"));
}

TEST(VetoedAnswer, OfSortingIsPresentedAgain) {
  Comparing session;
  while (session.compares()) session.answer(true);
  const TrialPlan answered = session.start();
  session.apply(Action{"dont_know"});
  const int n_completed = session.engine.n_completed();
  session.apply(by_mistake);
  EXPECT_EQ(session.engine.n_completed(), n_completed - 1);
  const TrialPlan again = session.start();
  EXPECT_EQ(again.task, "sorting");
  EXPECT_EQ(again.trial_number, answered.trial_number);
  EXPECT_EQ(again.condition, answered.condition);
}

TEST(VetoedAnswer, WithdrawsReversalAndEstimates) {
  Comparing session;
  Changes last;
  bool yes = true;
  while (session.compares()) last = session.answer(yes = !yes);
  ASSERT_THAT(last.estimates, ::testing::Not(IsEmpty())) << "it ended the last staircase";
  ASSERT_TRUE(session.engine.next().rest);
  const Changes changes = session.apply(by_mistake);
  EXPECT_THAT(changes.withdrawn_estimates, SizeIs(last.estimates.size()));
  EXPECT_THAT(changes.withdrawn_reversals, SizeIs(last.reversals.size()));
  EXPECT_TRUE(session.compares());
  EXPECT_FALSE(session.engine.next().rest) << "the break comes when the block is done";
}

TEST(VetoedAnswer, RepeatsNoBreak) {
  for (const bool told : {true, false}) {
    Comparing session;
    while (session.compares()) session.answer(true);
    ASSERT_TRUE(session.engine.next().rest);
    if (told) session.apply(BreakTaken{"break"});
    session.start();
    session.apply(TrialVoided{std::string(void_interrupted)});
    session.apply(by_mistake);
    EXPECT_FALSE(session.engine.next().rest);
    while (session.compares()) session.answer(true);
    EXPECT_EQ(session.engine.next().plan->task, "sorting");
    EXPECT_FALSE(session.engine.next().rest) << "it was taken before the answer was taken back";
  }
}

// With random vetoes, levels, reversals and estimates equal those of a session without vetoes.
RC_GTEST_PROP(VetoedAnswer, RestoresProcedures, ()) {
  Comparing straight, corrected;
  std::map<std::string, std::vector<double>> levels, reversals, expected_levels, expected_reversals;
  int n_estimates = 0, n_expected = 0;
  while (straight.compares()) {
    const bool yes = *rc::gen::arbitrary<bool>(), slip = *rc::gen::arbitrary<bool>();
    if (slip) {
      corrected.answer(!yes);
      if (*rc::gen::arbitrary<bool>() && corrected.compares()) {  // the next block has begun
        corrected.start();
        corrected.apply(TrialVoided{std::string(void_interrupted)});
      }
      corrected.apply(by_mistake);
    }
    const auto keep = [](const Changes& changes, auto& of_levels, auto& of_reversals, int& n) {
      of_levels[changes.trial->plan.staircase].push_back(*changes.trial->plan.level_g);
      for (const ReversalRow& row : changes.reversals)
        of_reversals[row.staircase].push_back(row.level_g + 1e4 * row.number);
      n += static_cast<int>(changes.estimates.size());
    };
    keep(straight.answer(yes), expected_levels, expected_reversals, n_expected);
    keep(corrected.answer(yes), levels, reversals, n_estimates);
  }
  RC_ASSERT(levels == expected_levels);
  RC_ASSERT(reversals == expected_reversals);
  RC_ASSERT(n_estimates == n_expected);
  RC_ASSERT(!corrected.compares());
}

}  // namespace
}  // namespace heft
