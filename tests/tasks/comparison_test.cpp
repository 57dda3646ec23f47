// Comparison task: responses to procedures, side of the reference, end of a trial.
#include "tasks/Comparison.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <map>

#include "psychophysics/Constant.h"
#include "psychophysics/Procedure.h"
#include "psychophysics/UpDown.h"

namespace heft {
namespace {

TrialRow row_of(const char* outcome, std::optional<int> chosen, std::optional<bool> correct) {
  TrialRow row;
  row.plan.reference_slot = 2;
  row.outcome = outcome;
  row.chosen_slot = chosen;
  row.choice_correct = correct;
  return row;
}

TEST(ComparisonAnswer, GivesChoiceAndSignToProcedure) {
  struct Expected {
    TrialRow row;
    Choice choice;
    bool any, correct;  // positive by each rule
  };
  const std::vector<Expected> all{{row_of("no_difference", {}, {}), Choice::none, false, false},
                                  {row_of("difference", 2, false), Choice::reference, true, false},
                                  {row_of("difference", 1, true), Choice::comparison, true, true},
                                  {row_of("difference", 1, {}), Choice::comparison, true, false}};
  for (const auto& [row, choice, any, correct] : all) {
    const Response by_any = Comparison::response_in(row, PositiveAnswer::any_choice);
    const Response by_correct = Comparison::response_in(row, PositiveAnswer::correct_choice);
    EXPECT_EQ(by_any.choice, choice);
    EXPECT_EQ(by_correct.choice, choice);
    EXPECT_EQ(by_any.positive, any);
    EXPECT_EQ(by_correct.positive, correct);
  }
}

TEST(ComparisonTrial, EndsWithAnyAnswer) {
  TrialPlan plan;
  plan.masses_g = {15, 115};
  plan.reference_slot = 1;
  for (const int slot : {1, 2}) {
    Comparison::Trial trial({}, plan, 0);
    EXPECT_TRUE(trial.ends({"select", slot}));
    trial.take({"select", slot});
    EXPECT_EQ(trial.result().outcome, "difference");
    EXPECT_EQ(trial.result().chosen_slot, slot);
    EXPECT_EQ(trial.result().choice_correct, slot == 2);
    EXPECT_EQ(trial.answer(), slot == 1 ? "reference" : "comparison");
  }
  Comparison::Trial none({}, plan, 0);
  EXPECT_TRUE(none.ends({"no_difference"}));
  none.take({"no_difference"});
  EXPECT_EQ(none.result().outcome, "no_difference");
  EXPECT_EQ(none.answer(), "none");
  plan.masses_g = {15, 15};
  Comparison::Trial equal({}, plan, 0);
  equal.take({"select", 1});
  EXPECT_FALSE(equal.result().choice_correct) << "neither is heavier";
}

// "heavier": the comparison was chosen, whatever the sign and at no difference.
TEST(ComparisonForcedChoice, GivesChoiceOfComparisonToProcedure) {
  for (const auto& [row, positive] : {std::pair(row_of("difference", 1, true), true),
                                      {row_of("difference", 1, false), true},
                                      {row_of("difference", 1, {}), true},
                                      {row_of("difference", 2, true), false},
                                      {row_of("difference", 2, {}), false}}) {
    const Response response =
        Comparison::response_in(row, PositiveAnswer::any_choice, ComparisonAnswers::heavier);
    EXPECT_EQ(response.positive, positive);
    EXPECT_EQ(response.choice, positive ? Choice::comparison : Choice::reference);
  }
}

TEST(ComparisonForcedChoice, RefusesNoDifference) {
  TrialPlan plan;
  plan.masses_g = {15, 115};
  plan.reference_slot = 1;
  Comparison::Block block;
  EXPECT_FALSE(Comparison::Trial(block, plan, 0).refusal({"no_difference"}));
  block.answers = ComparisonAnswers::heavier;
  Comparison::Trial forced(block, plan, 0);
  EXPECT_TRUE(forced.refusal({"no_difference"}));
  EXPECT_FALSE(forced.refusal({"select", 2}));
  EXPECT_EQ(forced.n_answers(), 2);
  EXPECT_FALSE(forced.detects());
  block.positive_answer = PositiveAnswer::correct_choice;
  ASSERT_EQ(block.check().size(), 1u);
  EXPECT_EQ(block.check()[0].keys.front(), "positive_answer");
}

TEST(ComparisonForcedChoice, IsAnsweredWithCubeByModels) {
  const Comparison::Offer offer{ComparisonAnswers::heavier};
  RandomStream stream(2, "test");
  int n_left = 0;
  for (int i = 0; i < 1000; ++i) {
    EXPECT_EQ(Comparison::simulated(offer, {.remembered_mm = {0.2, 0.1}}, stream),
              (Answer{{{"select", 1}}}));
    n_left += Comparison::blind(offer, {.n_slots = 2}, stream).actions.at(0).slot == 1;
  }
  EXPECT_NEAR(n_left, 500, 60);
}

// An observer without noise names the heavier cube: 1-up-1-down crosses 0 and stays about it.
TEST(ComparisonForcedChoice, LevelsOfBothSignsFollowTheResponses) {
  Comparison::Block block;
  block.name = "c";
  block.answers = ComparisonAnswers::heavier;
  block.staircases = {
      {100, {"one", UpDownConfig{.start = 40, .step = 16, .floor = -80, .stop_reversals = 6}}}};
  Comparison::Run run(block, 4);
  std::vector<double> levels_g;
  while (!run.finished()) {
    TrialRow row;
    row.plan = run.plan({4, static_cast<int>(levels_g.size()) + 1, 1});
    levels_g.push_back(*row.plan.level_g);
    row.outcome = "difference";
    const int reference = *row.plan.reference_slot;
    row.chosen_slot = *row.plan.level_g > 0 ? 3 - reference : reference;  // the heavier one
    Changes changes;
    run.complete(row, changes);
  }
  // by hand: 40 down to -8, then about 0
  const std::vector<double> first(levels_g.begin(), levels_g.begin() + 6);
  EXPECT_EQ(first, (std::vector<double>{40, 24, 8, -8, 8, -8}));
}

TEST(ComparisonSameDifferent, GivesDifferentToProcedureWithoutCube) {
  for (const bool different : {false, true}) {
    const Response response =
        Comparison::response_in(row_of(different ? "difference" : "no_difference", {}, {}),
                                PositiveAnswer::any_choice, ComparisonAnswers::same_different);
    EXPECT_EQ(response.positive, different);
    EXPECT_FALSE(response.choice);
  }
}

TEST(ComparisonSameDifferent, TakesSameAndDifferentButNoCube) {
  TrialPlan plan;
  plan.masses_g = {15, 115};
  plan.reference_slot = 1;
  Comparison::Block block;
  EXPECT_TRUE(Comparison::Trial(block, plan, 0).refusal({"different"})) << "with three answers";
  block.answers = ComparisonAnswers::heavier;
  EXPECT_TRUE(Comparison::Trial(block, plan, 0).refusal({"different"})) << "in a forced choice";
  block.answers = ComparisonAnswers::same_different;
  EXPECT_EQ(block.wording(), "same_different");
  Comparison::Trial same(block, plan, 0), different = same;
  EXPECT_TRUE(same.refusal({"select", 2}));
  EXPECT_FALSE(same.refusal({"no_difference"}));
  EXPECT_FALSE(same.refusal({"different"}));
  EXPECT_EQ(same.n_answers(), 2);
  same.take({"no_difference"});
  different.take({"different"});
  EXPECT_EQ(same.result().outcome, "no_difference");
  EXPECT_EQ(different.result().outcome, "difference");
  EXPECT_FALSE(different.result().chosen_slot);
  EXPECT_EQ(same.answer(), "none");
  EXPECT_EQ(different.answer(), "different");
  EXPECT_EQ(same.answered_different(), false);
  EXPECT_EQ(different.answered_different(), true);
  block.positive_answer = PositiveAnswer::correct_choice;
  ASSERT_EQ(block.check().size(), 1u);
  EXPECT_EQ(block.check()[0].keys.front(), "positive_answer");
}

TEST(ComparisonSameDifferent, IsAnsweredByWhetherModelsPerceiveADifference) {
  const Comparison::Offer offer{ComparisonAnswers::same_different};
  RandomStream stream(2, "test");
  for (const bool differ : {false, true}) {
    const Answer expected{{{differ ? "different" : "no_difference"}}};
    EXPECT_EQ(Comparison::simulated(offer, {.remembered_mm = {1, 2}, .differ = differ}, stream),
              expected);
    EXPECT_EQ(Comparison::blind(offer, {.n_slots = 2, .differ = differ}, stream), expected);
  }
  int n_different = 0;
  for (int i = 0; i < 1000; ++i)
    n_different += Comparison::simulated(offer, {.remembered_mm = {1, 2}, .lapse = true}, stream)
                       .actions.at(0)
                       .kind == "different";
  EXPECT_NEAR(n_different, 500, 60) << "a lapse is a coin";
}

Comparison::Block block_of(Sides sides) {
  Comparison::Block block;
  block.name = "c";
  block.sides = sides;
  block.staircases = {{100, {"one", ConstantConfig{.levels = {10, 20}, .n_per_level = 8}}},
                      {200, {"two", ConstantConfig{.levels = {30}, .n_per_level = 8}}}};
  block.catch_trials = {{100, 4}, {200, 4}};
  return block;
}

std::vector<TrialPlan> all_plans(const Comparison::Block& block, std::uint64_t seed,
                                 int attempt = 1) {
  Comparison::Run run(block, seed);
  std::vector<TrialPlan> plans;
  while (!run.finished()) {
    plans.push_back(run.plan({seed, static_cast<int>(plans.size()) + 1, attempt}));
    TrialRow row = row_of("no_difference", {}, {});
    row.plan = plans.back();
    Changes changes;
    run.complete(row, changes);
  }
  return plans;
}

TEST(ComparisonRun, BalancedSidesAreEqualInEveryFourTrials) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    std::map<std::string, std::vector<int>> sides;  // of each staircase, and "" of catch trials
    for (const TrialPlan& plan : all_plans(block_of(Sides::balanced), seed))
      sides[plan.staircase].push_back(*plan.reference_slot);
    ASSERT_EQ(sides.size(), 3u);
    for (const auto& [staircase, slots] : sides)
      for (std::size_t i = 0; i + 4 <= slots.size(); i += 4)
        EXPECT_EQ(std::count(slots.begin() + static_cast<long>(i),
                             slots.begin() + static_cast<long>(i) + 4, 1),
                  2)
            << staircase << " from " << i;
  }
}

TEST(ComparisonRun, RepeatedAttemptsAndRandomSidesAreDrawnFreely) {
  int n_unbalanced = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
    for (const int attempt : {1, 2}) {
      std::vector<int> slots;
      for (const TrialPlan& plan :
           all_plans(block_of(attempt == 1 ? Sides::random : Sides::balanced), seed, attempt))
        if (plan.staircase == "two" && slots.size() < 4) slots.push_back(*plan.reference_slot);
      n_unbalanced += std::count(slots.begin(), slots.end(), 1) != 2;
    }
  EXPECT_GT(n_unbalanced, 10) << "of 40, 25 expected";
}

TEST(ComparisonRun, PresentsReferenceAtItsSlot) {
  int n_catch = 0;
  for (const TrialPlan& plan : all_plans(block_of(Sides::random), 7)) {
    const std::size_t reference = plan.reference_slot == 1 ? 0 : 1;
    EXPECT_EQ(plan.masses_g[reference], plan.reference_g);
    EXPECT_EQ(plan.masses_g[1 - reference], *plan.reference_g + *plan.level_g);
    EXPECT_EQ(plan.is_catch, plan.level_g == 0);
    EXPECT_EQ(plan.is_catch, plan.staircase.empty());
    n_catch += plan.is_catch;
  }
  EXPECT_EQ(n_catch, 8);
}

// 24 trials of staircases, 6 in each block of 7.
TEST(ComparisonRun, HasACatchTrialInEachBlockButNoneAmongTheFirstThree) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const std::vector<TrialPlan> plans = all_plans(block_of(Sides::random), seed);
    const auto n_catch = [&](std::ptrdiff_t first, std::ptrdiff_t n) {
      return std::count_if(plans.begin() + first, plans.begin() + first + n,
                           [](const TrialPlan& plan) { return plan.is_catch; });
    };
    EXPECT_EQ(n_catch(0, 3), 0) << seed;
    for (const std::ptrdiff_t first : {0, 7, 14, 21})
      EXPECT_EQ(n_catch(first, 7), 1) << seed << ", from trial " << first + 1;
    EXPECT_EQ(n_catch(28, 4), 4) << seed;
  }
}

TEST(ComparisonRun, ReportsLastUnfinishedStaircase) {
  const Comparison::Block block = block_of(Sides::random);
  Comparison::Run run(block, 3);
  EXPECT_FALSE(run.unfinished_staircase());
  int n = 0;
  while (!run.unfinished_staircase()) {
    ASSERT_FALSE(run.finished());
    TrialRow row = row_of("no_difference", {}, {});
    row.plan = run.plan({3, ++n, 1});
    Changes changes;
    run.complete(row, changes);
  }
  EXPECT_EQ(run.unfinished_staircase(), "one") << "it has more trials";
}

TEST(ComparisonKeys, CatchTrialsAreFixedOrRandom) {
  Comparison::Block block = block_of(Sides::random);
  EXPECT_TRUE(block.check().empty());
  EXPECT_EQ(block.expected_staircase_trials(), 24);
  EXPECT_EQ(block.expected_trials(), 32);
  block.catch_fraction = 0.1;
  ASSERT_EQ(block.check().size(), 1u);
  EXPECT_EQ(block.check()[0].keys.front(), "catch_fraction");
}

TEST(ComparisonKeys, ExpectedTrialsAddOverReferences) {
  const auto block_of = [](const std::vector<double>& starts_g) {
    Comparison::Block block;
    for (const double start_g : starts_g)
      block.staircases.push_back(
          {start_g,
           {fmt::format("{}", start_g), UpDownConfig{.start = start_g, .step = 50, .floor = 0}},
           {}});
    return block;
  };
  EXPECT_DOUBLE_EQ(
      block_of({200, 800}).expected_staircase_trials(),
      block_of({200}).expected_staircase_trials() + block_of({800}).expected_staircase_trials());
  EXPECT_TRUE(block_of({200}).depends_on_answers());
}

TEST(ComparisonAnswer, LapseIsDifferenceInTwoOfThree) {
  RandomStream stream(1, "test");
  int n_different = 0;
  for (int i = 0; i < 3000; ++i) {
    const Answer answer =
        Comparison::simulated({}, {.remembered_mm = {0.1, 0.2}, .lapse = true}, stream);
    n_different += answer.actions.at(0).kind == "select";
  }
  EXPECT_NEAR(n_different, 2000, 150);
}

}  // namespace
}  // namespace heft
