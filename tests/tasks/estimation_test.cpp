// Magnitude estimation: order of cubes, valid numbers, the standard.
#include "tasks/Estimation.h"

#include <gmock/gmock.h>

#include <map>

#include "tasks/Plans.h"
#include "tasks/blocks/SessionPlan.h"

namespace heft {
namespace {
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::plans;

Estimation::Block block_of_numbers() {
  Estimation::Block block;
  block.name = "estimation";
  block.masses_g = {15, 100, 400};
  block.trials = {{"C1", 1}, {"C2", 2}};
  block.low = 1;
  block.high = 100;
  return block;
}

Action estimate(double value) {
  return {"estimate", {}, {}, value};
}

TEST(Estimation, TrialsAreBalancedInSeededOrder) {
  std::map<std::pair<double, std::string>, int> counts;
  for (const TrialPlan& plan : plans(block_of_numbers(), 7)) {
    ASSERT_EQ(plan.masses_g.size(), 1u) << "one cube a trial";
    EXPECT_FALSE(plan.is_practice);
    ++counts[{plan.masses_g[0], plan.condition}];
  }
  EXPECT_EQ(counts.size(), 6u);
  for (const auto& [stimulus, n] : counts) EXPECT_EQ(n, stimulus.second == "C1" ? 1 : 2);
  const auto masses = [](std::uint64_t seed) {
    std::vector<double> masses_g;
    for (const TrialPlan& plan : plans(block_of_numbers(), seed))
      masses_g.push_back(plan.masses_g[0]);
    return masses_g;
  };
  EXPECT_EQ(masses(7), masses(7));
  EXPECT_NE(masses(7), masses(8));
}

TEST(Estimation, CubesOfOneMassMayDifferInFriction) {
  Estimation::Block block = block_of_numbers();
  block.masses_g = {100, 100, 400};
  EXPECT_FALSE(block.check().empty());
  block.table_friction = {0.8, 0.2, 0.2};
  EXPECT_THAT(block.check(), IsEmpty());
  std::map<std::pair<double, double>, int> counts;
  for (const TrialPlan& plan : plans(block, 7)) {
    ASSERT_EQ(plan.table_friction.size(), 1u);
    ++counts[{plan.masses_g[0], plan.table_friction[0]}];
  }
  using Counts = std::map<std::pair<double, double>, int>;
  EXPECT_EQ(counts, (Counts{{{100, 0.8}, 3}, {{100, 0.2}, 3}, {{400, 0.2}, 3}}));
  block.table_friction = {0.2, 0.2, 0.2};
  EXPECT_THAT(block.check().at(0).expected, HasSubstr("different masses or table_friction"));
  block.table_friction = {0.2, 0.8};
  EXPECT_THAT(block.check().at(0).expected, HasSubstr("one for each mass"));
}

TEST(Estimation, StandardComesFirstAsPractice) {
  Estimation::Block block = block_of_numbers();
  block.modulus = {200, 10};
  const std::vector<TrialPlan> all = plans(block, 7);
  ASSERT_EQ(all.size(), 10u);
  EXPECT_TRUE(all[0].is_practice);
  EXPECT_EQ(all[0].masses_g, std::vector{200.0});
  EXPECT_EQ(all[0].condition, "C1") << "the first technique";
  for (std::size_t i = 1; i < all.size(); ++i) EXPECT_FALSE(all[i].is_practice);

  Estimation::Trial standard(block, all[0], 7);
  EXPECT_THAT(*standard.refusal(estimate(10)), HasSubstr("not estimated"));
  EXPECT_FALSE(standard.refusal({"validate"}));
  standard.take({"validate"});
  EXPECT_EQ(standard.result().outcome, "shown");
  EXPECT_FALSE(standard.result().value);
  ScreenState screen;
  Estimation::Trial(block, all[1], 7).show(screen);
  const auto& offer = std::any_cast<const Estimation::Offer&>(screen.offer);
  EXPECT_FALSE(offer.is_standard);
  EXPECT_EQ(offer.modulus->value, 10) << "every later screen names it";
}

TEST(Estimation, AcceptsNumbersInRange) {
  const Estimation::Block block = block_of_numbers();
  Estimation::Trial trial(block, plans(block, 7)[0], 7);
  EXPECT_FALSE(trial.refusal(estimate(1)));
  EXPECT_FALSE(trial.refusal(estimate(2.5)));
  EXPECT_FALSE(trial.refusal(estimate(100)));
  EXPECT_THAT(*trial.refusal(estimate(0.99)), HasSubstr("from 1 to 100"));
  EXPECT_TRUE(trial.refusal(estimate(100.5)));
  EXPECT_TRUE(trial.refusal(estimate(std::nan(""))));
  EXPECT_TRUE(trial.refusal({"validate"})) << "that is for the standard";
  trial.take(estimate(42.5));
  EXPECT_EQ(trial.result().outcome, "estimated");
  EXPECT_EQ(trial.result().value, 42.5);
  EXPECT_EQ(trial.answer(), "42.5");
  trial.take(estimate(42.51));  // differs, although equal to three digits
  EXPECT_EQ(trial.answer(), "42.51");
}

TEST(Estimation, SliderAndQuestionAcceptWholeNumbers) {
  Estimation::Block block = block_of_numbers();
  block.low = block.high = std::nullopt;
  block.scale = "slider";
  const TrialPlan plan = plans(block, 7)[0];
  EXPECT_FALSE(Estimation::Trial(block, plan, 7).refusal(estimate(0)));
  EXPECT_TRUE(Estimation::Trial(block, plan, 7).refusal(estimate(0.5)));
  EXPECT_TRUE(Estimation::Trial(block, plan, 7).refusal(estimate(101)));

  FormQuestion effort, told;
  effort.key = "effort";
  effort.kind = QuestionKind::choice;
  effort.choices = {{"a", "A"}, {"b", "B"}, {"c", "C"}};
  told.key = "told";
  told.kind = QuestionKind::text;
  const std::map<std::string, Questionnaire> forms{{"borg", {"", "", {effort, told}}}};
  block.scale = "borg.effort";
  EXPECT_EQ(block.questionnaire(), "borg");
  TaskBlock asked(block);
  EXPECT_TRUE(asked.lacks_question());
  asked.read_question(forms);
  EXPECT_FALSE(asked.lacks_question());
  EXPECT_FALSE(asked.trial(plan, 7)->refusal(estimate(3)));
  EXPECT_TRUE(asked.trial(plan, 7)->refusal(estimate(4))) << "three choices";
  for (const char* scale : {"borg.told", "borg.other", "other.effort"}) {
    block.scale = scale;
    TaskBlock other(block);
    other.read_question(forms);
    EXPECT_TRUE(other.lacks_question()) << scale;
  }
}

TEST(Estimation, KeysAreChecked) {
  const auto keys = [](const Estimation::Block& block) {
    std::vector<std::string> wrong;
    for (const ConfigMistake& mistake : block.check()) wrong.emplace_back(mistake.keys.front());
    return wrong;
  };
  EXPECT_THAT(keys(block_of_numbers()), IsEmpty());
  Estimation::Block block = block_of_numbers();
  block.masses_g = {15, 15};
  EXPECT_THAT(keys(block), Contains("masses_g"));
  block = block_of_numbers();
  block.high = std::nullopt;
  EXPECT_THAT(keys(block), Contains("high"));
  block = block_of_numbers();
  block.low = 100;
  EXPECT_THAT(keys(block), Contains("high"));
  block = block_of_numbers();
  block.modulus = {100, 200};
  EXPECT_THAT(keys(block), Contains("modulus"));
  block = block_of_numbers();
  block.scale = "slider";
  EXPECT_THAT(keys(block), ::testing::UnorderedElementsAre("low", "high"));
  block = block_of_numbers();
  block.trials = {{"C1", 0}};
  EXPECT_THAT(keys(block), Contains("trials"));
  block = block_of_numbers();
  block.scale = "nothing";
  EXPECT_THAT(keys(block), Contains("scale"));
}

TEST(Estimation, SimulatedAnswerIncreasesWithLagWithinScale) {
  RandomStream stream(1, "test");
  Estimation::Offer offer;
  offer.question.kind = QuestionKind::number;
  offer.question.least = 1;
  offer.question.most = 500;
  double before = 0;
  for (const double lag_mm : {0.0, 2.0, 10.0, 50.0, 99.0}) {
    const Answer answer = Estimation::simulated(offer, {.remembered_mm = {lag_mm}}, stream);
    ASSERT_EQ(answer.actions.size(), 1u);
    EXPECT_GT(*answer.actions[0].value, before);
    before = *answer.actions[0].value;
  }
  for (const double lag_mm : {-20.0, 1e4}) {
    const Answer answer = Estimation::simulated(offer, {.remembered_mm = {lag_mm}}, stream);
    EXPECT_EQ(*answer.actions[0].value, lag_mm < 0 ? 1 : 500);
  }
  offer.is_standard = true;
  EXPECT_EQ(Estimation::blind(offer, {1}, stream).actions[0].kind, "validate");
}

// A cube of 100 g lags by 15.7 mm with the paper's spring: friction 0.8, 50 N/m.
TEST(Estimation, SimulatedAnswerIsProportionalToModulus) {
  RandomStream stream(1, "test");
  Estimation::Offer offer;
  offer.question.kind = QuestionKind::number;
  offer.question.least = 1;
  offer.question.most = 500;
  const auto number = [&](double lag_mm, bool lapse = false) {
    const Percepts percepts{.remembered_mm = {lag_mm}, .lapse = lapse};
    return *Estimation::simulated(offer, percepts, stream).actions.at(0).value;
  };
  offer.modulus = {100, 10};
  EXPECT_EQ(number(15.7), 10);
  EXPECT_EQ(number(31.4), 20) << "twice the mass";
  offer.modulus = {50, 10};
  EXPECT_EQ(number(15.7), 20) << "of a lighter standard";
  offer.modulus = {100, 40};
  EXPECT_EQ(number(15.7), 40) << "of another number";
  EXPECT_EQ(number(0), 1) << "the scale's lower end";
  EXPECT_EQ(number(1000), 500) << "its upper end";
  EXPECT_EQ(number(0.5, true), 251) << "a lapse is a place on the scale, whatever the standard";
  offer.is_standard = true;
  EXPECT_EQ(Estimation::simulated(offer, {.remembered_mm = {15.7}}, stream).actions[0].kind,
            "validate");
}

TEST(Estimation, FullestScreensIncludeStandard) {
  int n_standard = 0;
  for (const ScreenState& screen : Estimation::fullest_screens())
    n_standard += std::any_cast<const Estimation::Offer&>(screen.offer).is_standard;
  EXPECT_EQ(n_standard, 1);
}

}  // namespace
}  // namespace heft
