// Comparisons with a real object: plans, the order of lifting and answering, simulated answers.
#include <gmock/gmock.h>

#include "psychophysics/Constant.h"
#include "responders/decision/Decision.h"
#include "tasks/Comparison.h"

namespace heft {
namespace {
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

Comparison::Block block_with(ComparisonAnswers answers) {
  Comparison::Block block;
  block.name = "against brass";
  block.answers = answers;
  block.reference = RealObject{"brass", 200};
  block.staircases = {{200, {"levels", ConstantConfig{.levels = {-50, 50}, .n_per_level = 3}}}};
  return block;
}

const Comparison::Block three = block_with(ComparisonAnswers::heavier_or_none);

std::vector<TrialPlan> plans(const Comparison::Block& block, std::uint64_t seed) {
  Comparison::Run run(block, seed);
  std::vector<TrialPlan> plans;
  while (!run.finished()) {
    TrialRow row;
    row.plan = run.plan({seed, static_cast<int>(plans.size()) + 1, 1});
    row.outcome = "no_difference";
    plans.push_back(row.plan);
    Changes changes;
    run.complete(row, changes);
  }
  return plans;
}

TEST(RealReference, HasNoCube) {
  EXPECT_EQ(three.most_cubes(), 1);
  EXPECT_GT(three.trial_s(), Comparison::Block().trial_s()) << "lifting takes time";
  for (const TrialPlan& plan : plans(three, 3)) {
    EXPECT_THAT(plan.masses_g, ElementsAre(200 + *plan.level_g));
    EXPECT_EQ(plan.reference_slot, 2);
    EXPECT_EQ(plan.real_reference_g(), 200);
  }
  Comparison::Block virtual_one = three;
  virtual_one.reference.reset();
  for (const TrialPlan& plan : plans(virtual_one, 3)) EXPECT_FALSE(plan.real_reference_g());
}

TEST(RealReference, IsLiftedBeforeTheAnswer) {
  const TrialPlan plan = plans(three, 3).front();
  Comparison::Trial trial(three, plan, 3);
  for (const Action& action :
       {Action{"select", 1}, Action{"select_object"}, Action{"no_difference"}})
    EXPECT_THAT(trial.refusal(action).value_or(""), HasSubstr("not been lifted"));
  ScreenState screen;
  trial.show(screen);
  EXPECT_FALSE(screen.can_validate);
  for (int i = 0; i < 2; ++i) {  // as often as the participant likes
    EXPECT_FALSE(trial.refusal({"lifted"}));
    EXPECT_FALSE(trial.ends({"lifted"}));
    trial.take({"lifted"});
  }
  trial.show(screen);
  EXPECT_TRUE(screen.can_validate);
  const auto offer = std::any_cast<Comparison::Offer>(screen.offer);
  EXPECT_EQ(offer.object, "brass");
  EXPECT_TRUE(offer.was_lifted);
  EXPECT_FALSE(trial.refusal({"select_object"}));
  EXPECT_EQ(trial.n_answers(), 3);
  Comparison::Block virtual_one = three;
  virtual_one.reference.reset();
  for (const char* kind : {"lifted", "select_object"})
    EXPECT_TRUE(Comparison::Trial(virtual_one, plan, 3).refusal({kind})) << kind;
}

TEST(RealReference, TakesPartInTheAnswerAsTheReference) {
  for (const TrialPlan& plan : plans(three, 3))
    for (const bool object : {false, true}) {
      Comparison::Trial trial(three, plan, 3);
      trial.take({"lifted"});
      trial.take(object ? Action{"select_object"} : Action{"select", 1});
      EXPECT_EQ(trial.result().outcome, "difference");
      EXPECT_EQ(trial.result().chosen_slot, object ? 2 : 1);
      EXPECT_EQ(trial.result().choice_correct, object == (*plan.level_g < 0));
      EXPECT_EQ(trial.answer(), object ? "reference" : "comparison");
      TrialRow row;
      row.plan = plan;
      static_cast<TrialResult&>(row) = trial.result();
      EXPECT_EQ(Comparison::response_in(row, PositiveAnswer::any_choice).choice,
                object ? Choice::reference : Choice::comparison);
    }
}

TEST(RealReference, AnswersSuitTheQuestion) {
  const TrialPlan plan = plans(three, 3).front();
  const Comparison::Block forced = block_with(ComparisonAnswers::heavier),
                          same = block_with(ComparisonAnswers::same_different);
  Comparison::Trial of_forced(forced, plan, 3), of_same(same, plan, 3);
  of_forced.take({"lifted"});
  of_same.take({"lifted"});
  EXPECT_FALSE(of_forced.refusal({"select_object"}));
  EXPECT_TRUE(of_forced.refusal({"no_difference"}));
  EXPECT_TRUE(of_same.refusal({"select_object"}));
  EXPECT_FALSE(of_same.refusal({"different"}));
  EXPECT_EQ(of_forced.n_answers(), 2);
  EXPECT_EQ(of_same.n_answers(), 2);
  EXPECT_EQ(three.wording(), "object");
  EXPECT_EQ(forced.wording(), "object_heavier");
  EXPECT_EQ(same.wording(), "object_same_different");
}

TEST(RealReference, IsFeltWithoutItsCue) {
  ResponderParameters exact;
  for (double ResponderParameters::*const none :
       {&ResponderParameters::judgment_noise_mm, &ResponderParameters::memory_noise,
        &ResponderParameters::lapse_rate, &ResponderParameters::guess_probability})
    exact.*none = 0;
  exact.criterion_mm = 10;
  exact.criterion_fraction = 0;
  const auto answer = [&](double seen_mm) {
    TrialView view;
    view.task = "comparison";
    view.lifted_g = 200;
    view.offer = Comparison::Offer{ComparisonAnswers::heavier_or_none, "brass"};
    return Decision(exact, 1, view).decide(std::vector<double>{seen_mm}, {});
  };
  const double felt_mm = 200 * mm_per_g;
  EXPECT_EQ(answer(felt_mm + 11), (Answer{{{"lifted"}, {"select", 1}}}));
  EXPECT_EQ(answer(felt_mm - 11), (Answer{{{"lifted"}, {"select_object"}}}));
  EXPECT_EQ(answer(felt_mm - 9), (Answer{{{"lifted"}, {"no_difference"}}}));
}

TEST(RealReference, BlindAnswersLiftToo) {
  RandomStream stream(2, "test");
  int n_cube = 0;
  for (int i = 0; i < 1000; ++i) {
    const Answer answer =
        Comparison::blind({ComparisonAnswers::heavier, "brass"}, {.n_slots = 1}, stream);
    ASSERT_THAT(answer.actions, SizeIs(2));
    EXPECT_EQ(answer.actions[0].kind, "lifted");
    n_cube += answer.actions[1].kind == "select";
  }
  EXPECT_NEAR(n_cube, 500, 60);
}

TEST(RealReference, KeysAreChecked) {
  EXPECT_THAT(three.check(), IsEmpty());
  Comparison::Block block = three;
  block.sides = Sides::balanced;
  ASSERT_THAT(block.check(), SizeIs(1));
  EXPECT_EQ(block.check()[0].keys.front(), "sides");
  for (const char* name : {"", "a brass cylinder with a hook"}) {
    block = three;
    block.reference->name = name;
    ASSERT_THAT(block.check(), SizeIs(1)) << name;
    EXPECT_EQ(block.check()[0].keys.front(), "reference");
  }
  block.reference->name = "éééééééééééééééééééééééé";  // 24 characters, 48 bytes
  EXPECT_THAT(block.check(), IsEmpty());
}

}  // namespace
}  // namespace heft
