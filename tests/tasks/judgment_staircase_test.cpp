// Judgments whose masses a procedure sets: plans, responses, simulated answers, checks.
#include <gmock/gmock.h>

#include <map>
#include <set>

#include "psychophysics/Constant.h"
#include "psychophysics/UpDown.h"
#include "tasks/Judgment.h"
#include "tasks/blocks/SessionPlan.h"

namespace heft {
namespace {
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const Meanings yes_no{{"no", Meaning::negative}, {"yes", Meaning::positive}};
const Meanings sides{{"left", Meaning::left}, {"right", Meaning::right}};
const Meanings sides_or_none{
    {"left", Meaning::left}, {"right", Meaning::right}, {"same", Meaning::none}};

// Its choices are those of the responses, in this order.
Judgment::Block block_of(const Meanings& responses, double reference_g,
                         const Procedure& procedure) {
  Judgment::Block block;
  block.name = "judged";
  block.asks = "mine.asked";
  block.question = FormQuestion{};
  block.question->kind = QuestionKind::choice;
  for (const auto& [value, meaning] : responses)
    block.question->choices.push_back({value, "words"});
  block.responses = responses;
  block.staircases = {{reference_g, procedure}};
  return block;
}

Procedure up_down(double start, double floor = 10) {
  return {"steps", UpDownConfig{.start = start, .step = 50, .floor = floor, .stop_reversals = 4}};
}

std::vector<std::string_view> wrong_keys(const Judgment::Block& block) {
  std::vector<std::string_view> wrong;
  for (const ConfigMistake& mistake : block.check()) wrong.push_back(mistake.keys.front());
  return wrong;
}

TrialRow answered(const TrialPlan& plan, double value) {
  TrialRow row;
  row.plan = plan;
  row.value = value;
  row.outcome = "chosen";
  return row;
}

// The observer finds 180 g and more heavy.
TEST(JudgmentStaircase, OfOneCubeGoesToTheMassWhereTheAnswerChanges) {
  const Judgment::Block block = block_of(yes_no, 0, up_down(400));
  EXPECT_EQ(block.most_cubes(), 1);
  EXPECT_TRUE(block.depends_on_answers());
  Judgment::Run run(block, 4);
  std::vector<double> masses_g;
  Changes last;
  while (!run.finished()) {
    const TrialPlan plan = run.plan({4, static_cast<int>(masses_g.size()) + 1, 1});
    EXPECT_EQ(plan.staircase, "steps");
    EXPECT_THAT(plan.masses_g, ElementsAre(*plan.level_g));
    EXPECT_FALSE(plan.reference_g || plan.reference_slot);
    masses_g.push_back(plan.masses_g.at(0));
    last = {};
    run.complete(answered(plan, masses_g.back() > 180 ? 2 : 1), last);
  }
  EXPECT_THAT(masses_g, ElementsAre(400, 350, 300, 250, 200, 150, 200, 150, 200));  // by hand
  ASSERT_EQ(last.estimates.size(), 1u);
  EXPECT_EQ(last.estimates[0].jnd_g, 175);
  EXPECT_EQ(last.reversals.size(), 1u);
}

TEST(JudgmentStaircase, WithReferenceShowsItOnRandomSides) {
  const Judgment::Block block =
      block_of(sides, 200, {"all", ConstantConfig{.levels = {-100, 100}, .n_per_level = 40}});
  EXPECT_EQ(block.most_cubes(), 2);
  EXPECT_EQ(block.expected_trials(), 80);
  Judgment::Run run(block, 4);
  std::map<int, int> n_on;
  for (int i = 1; !run.finished(); ++i) {
    const TrialPlan plan = run.plan({4, i, 1});
    EXPECT_EQ(plan.reference_g, 200);
    ASSERT_EQ(plan.masses_g.size(), 2u);
    const auto reference = static_cast<std::size_t>(*plan.reference_slot - 1);
    EXPECT_EQ(plan.masses_g[reference], 200);
    EXPECT_EQ(plan.masses_g[1 - reference], 200 + *plan.level_g);
    ++n_on[*plan.reference_slot];
    Changes changes;
    run.complete(answered(plan, 1), changes);
  }
  EXPECT_GT(n_on[1], 20);
  EXPECT_GT(n_on[2], 20);
}

TEST(JudgmentStaircase, ChoicesAreResponses) {
  TrialRow row;
  row.plan.reference_slot = 2;
  const auto response = [&](const Meanings& responses, double place) {
    row.value = place;
    return block_of(responses, 200, up_down(100)).response_in(row);
  };
  EXPECT_FALSE(response(yes_no, 1).positive);
  EXPECT_TRUE(response(yes_no, 2).positive);
  EXPECT_FALSE(response(yes_no, 2).choice);
  for (const Meanings& responses : {sides, sides_or_none}) {
    EXPECT_EQ(response(responses, 1).choice, Choice::comparison);
    EXPECT_EQ(response(responses, 2).choice, Choice::reference);
    EXPECT_TRUE(response(responses, 1).positive);
    EXPECT_EQ(response(responses, 2).positive, responses.size() == 3)
        << "with a third answer either cube is a difference";
  }
  EXPECT_EQ(response(sides_or_none, 3).choice, Choice::none);
  EXPECT_FALSE(response(sides_or_none, 3).positive);
  row.plan.reference_slot = 1;
  EXPECT_EQ(response(sides, 1).choice, Choice::reference);
  // A choice of numbers is logged as its number.
  const Meanings numbers{{"0", Meaning::negative}, {"1", Meaning::positive}};
  EXPECT_TRUE(response(numbers, 1).positive);
  EXPECT_FALSE(response(numbers, 0).positive);
}

TEST(JudgmentStaircase, KeysAreChecked) {
  EXPECT_THAT(wrong_keys(block_of(yes_no, 0, up_down(400))), IsEmpty());
  EXPECT_THAT(wrong_keys(block_of(sides_or_none, 200, up_down(400))), IsEmpty());
  EXPECT_THAT(wrong_keys(block_of({}, 200, up_down(400))), ElementsAre("responses"));
  EXPECT_THAT(wrong_keys(block_of(sides, 0, up_down(400))), ElementsAre("responses"))
      << "one cube has no sides";
  for (const Meanings& responses :
       {Meanings{{"yes", Meaning::positive}}, Meanings{{"a", Meaning::left}, {"b", Meaning::none}},
        Meanings{{"a", Meaning::left}, {"b", Meaning::right}, {"c", Meaning::positive}}})
    EXPECT_THAT(wrong_keys(block_of(responses, 200, up_down(400))), ElementsAre("responses"));
  Judgment::Block block = block_of(yes_no, 200, up_down(400));
  block.staircases.push_back({0, {"other", UpDownConfig{.start = 100, .step = 20, .floor = 10}}});
  EXPECT_THAT(wrong_keys(block), ElementsAre("staircase"));
  block = block_of(yes_no, 200, up_down(400));
  block.masses_g = {100};
  EXPECT_THAT(wrong_keys(block), ElementsAre("masses_g"));
  block.staircases.clear();
  EXPECT_THAT(wrong_keys(block), ElementsAre("responses")) << "to nothing";
}

TEST(JudgmentStaircase, NeedsAResponseForEachChoice) {
  Judgment::Block block = block_of(yes_no, 0, up_down(400));
  EXPECT_FALSE(TaskBlock(block).mistake_in_question());
  block.question->choices.push_back({"perhaps", "words"});
  EXPECT_THAT(TaskBlock(block).mistake_in_question().value_or(""), HasSubstr("\"perhaps\""));
  block = block_of(yes_no, 0, up_down(400));
  block.responses.emplace_back("never", Meaning::negative);
  EXPECT_THAT(TaskBlock(block).mistake_in_question().value_or(""), HasSubstr("\"never\""));
  block.question->kind = QuestionKind::slider;
  EXPECT_THAT(TaskBlock(block).mistake_in_question().value_or(""), HasSubstr("is no choice"));
}

double simulated(const Meanings& responses, const Percepts& percepts) {
  const Judgment::Block block = block_of(responses, 200, up_down(400));
  RandomStream stream(1, "answer");
  return Judgment::simulated({*block.question, responses}, percepts, stream)
      .actions.at(0)
      .value.value();
}

TEST(JudgmentStaircase, SimulatedAnswersKnowWhatChoicesMean) {
  EXPECT_EQ(simulated(yes_no, {.remembered_mm = {5}}), 1) << "light";
  EXPECT_EQ(simulated(yes_no, {.remembered_mm = {40}}), 2) << "heavy";
  EXPECT_EQ(simulated(yes_no, {.remembered_mm = {5, 40}, .differ = false}), 1);
  EXPECT_EQ(simulated(yes_no, {.remembered_mm = {5, 40}, .differ = true}), 2);
  EXPECT_EQ(simulated(sides_or_none, {.remembered_mm = {5, 40}, .differ = true}), 2);
  EXPECT_EQ(simulated(sides_or_none, {.remembered_mm = {40, 5}, .differ = true}), 1);
  EXPECT_EQ(simulated(sides_or_none, {.remembered_mm = {40, 5}, .differ = false}), 3);
  EXPECT_EQ(simulated(sides, {.remembered_mm = {40, 5}, .differ = false}), 1) << "forced";
}

TEST(JudgmentStaircase, BlindAnswersAreYesOrNo) {
  const Judgment::Block block = block_of(yes_no, 0, up_down(400));
  RandomStream stream(1, "answer");
  for (const bool differ : {false, true})
    EXPECT_EQ(Judgment::blind({*block.question, yes_no}, {1, differ}, stream).actions.at(0).value,
              differ ? 2 : 1);
  std::set<double> given;
  const Judgment::Block pair = block_of(sides, 200, up_down(400));
  for (int i = 0; i < 40; ++i)
    given.insert(*Judgment::blind({*pair.question, sides}, {2, true}, stream).actions[0].value);
  EXPECT_EQ(given, (std::set<double>{1, 2})) << "a coin";
}

TEST(JudgmentStaircase, PracticeShowsFirstLevelsAndAdvancesNoProcedure) {
  TaskBlock block(block_of(yes_no, 0, up_down(400)));
  block.practice = Practice{.trials = 2};
  const auto run = block.run(4);
  for (int i = 1; i <= 3; ++i) {
    const TrialPlan plan = run->plan({4, i, 1});
    EXPECT_EQ(plan.is_practice, i < 3);
    EXPECT_EQ(plan.staircase, i < 3 ? "" : "steps");
    EXPECT_EQ(plan.level_g, 400);
    Changes changes;
    run->complete(answered(plan, 2), changes);
  }
  EXPECT_EQ(run->plan({4, 4, 1}).level_g, 350);
}

}  // namespace
}  // namespace heft
