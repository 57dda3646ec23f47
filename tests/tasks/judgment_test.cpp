// Judgments: sets of cubes and their order, valid answers, what simulated participants answer.
// Whole sessions of the task are in every_task_test.cpp.
#include "tasks/Judgment.h"

#include <gmock/gmock.h>

#include <map>

#include "tasks/Plans.h"
#include "tasks/blocks/SessionPlan.h"

namespace heft {
namespace {
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::plans;
using ::testing::SizeIs;
using ::testing::UnorderedElementsAre;
using Masses = std::vector<double>;

FormQuestion asked(QuestionKind kind) {
  FormQuestion question;
  question.key = "asked";
  question.kind = kind;
  return question;
}

FormQuestion likert(int from, int to) {
  FormQuestion question = asked(QuestionKind::likert);
  question.from = from;
  question.to = to;
  return question;
}

FormQuestion choice(const std::vector<std::string>& values) {
  FormQuestion question = asked(QuestionKind::choice);
  for (const std::string& value : values) question.choices.push_back({value, "words"});
  return question;
}

FormQuestion number(double least, double most) {
  FormQuestion question = asked(QuestionKind::number);
  question.least = least;
  question.most = most;
  return question;
}

Judgment::Block block_of(const Masses& masses_g, int cubes = 0) {
  Judgment::Block block;
  block.name = "pairs";
  block.masses_g = masses_g;
  block.cubes = cubes;
  block.asks = "mine.asked";
  block.question = likert(1, 7);
  return block;
}

std::vector<Masses> masses_of(const std::vector<CubeSet>& sets) {
  std::vector<Masses> all;
  for (const CubeSet& one : sets) all.push_back(one.masses_g);
  return all;
}

Action judge(double value) {
  return {"judge", {}, {}, value};
}

double simulated(const FormQuestion& question, const Masses& remembered_mm, bool lapse = false) {
  RandomStream stream(1, "answer");
  const Percepts percepts{.remembered_mm = remembered_mm, .lapse = lapse};
  const Answer answer = Judgment::simulated({question}, percepts, stream);
  EXPECT_THAT(answer.actions, SizeIs(1));
  EXPECT_EQ(answer.actions.at(0).kind, "judge");
  return answer.actions.at(0).value.value();
}

TEST(JudgmentSets, AreAllCubesOrAllDifferentSetsOfSoMany) {
  EXPECT_THAT(masses_of(block_of({15, 100, 400}).sets()), ElementsAre(Masses{15, 100, 400}));
  EXPECT_THAT(masses_of(block_of({15, 100, 400}, 1).sets()),
              ElementsAre(Masses{15}, Masses{100}, Masses{400}));
  EXPECT_THAT(masses_of(block_of({15, 100, 400}, 2).sets()),
              ElementsAre(Masses{15, 100}, Masses{15, 400}, Masses{100, 400}));
  EXPECT_THAT(block_of({1, 2, 3, 4, 5, 6}, 3).sets(), SizeIs(20));
  EXPECT_THAT(masses_of(block_of({200, 200, 300}, 2).sets()),
              ElementsAre(Masses{200, 200}, Masses{200, 300}))
      << "the same pair counts once, whichever of two equal cubes is in it";
  Judgment::Block block = block_of({200, 200}, 1);
  block.table_friction = {0.2, 0.8};
  EXPECT_THAT(block.sets(), SizeIs(2)) << "cubes that differ in friction are different";
}

TEST(JudgmentRun, ShowsEachSetWithEachTechniqueInSeededOrder) {
  Judgment::Block block = block_of({15, 100, 400}, 2);
  block.trials = {{"C1", 1}, {"C2", 2}};
  EXPECT_EQ(block.expected_trials(), 9);
  std::map<std::pair<Masses, std::string>, int> counts;
  for (const TrialPlan& plan : plans(block, 7)) {
    EXPECT_EQ(plan.task, "judgment");
    Masses sorted = plan.masses_g;
    std::ranges::sort(sorted);
    ++counts[{sorted, plan.condition}];
  }
  EXPECT_THAT(counts, SizeIs(6));
  for (const auto& [shown, n] : counts) EXPECT_EQ(n, shown.second == "C1" ? 1 : 2);
  const auto masses = [&](std::uint64_t seed, int attempt = 1) {
    std::vector<Masses> all;
    for (const TrialPlan& plan : plans(block, seed, attempt)) all.push_back(plan.masses_g);
    return all;
  };
  EXPECT_EQ(masses(7), masses(7));
  EXPECT_NE(masses(7), masses(8));
  EXPECT_NE(masses(7), masses(7, 2)) << "a repeated attempt is arranged again";
}

TEST(JudgmentRun, ArrangesCubesWithTheirFriction) {
  Judgment::Block block = block_of({15, 100, 400, 800});
  block.table_friction = {0.1, 0.2, 0.3, 0.4};
  block.trials = {{"C2", 12}};
  const std::map<double, double> friction{{15, 0.1}, {100, 0.2}, {400, 0.3}, {800, 0.4}};
  std::set<double> leftmost;
  for (const TrialPlan& plan : plans(block, 7)) {
    EXPECT_THAT(plan.masses_g, UnorderedElementsAre(15, 100, 400, 800));
    ASSERT_EQ(plan.table_friction.size(), 4u);
    leftmost.insert(plan.masses_g[0]);
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_EQ(plan.table_friction[i], friction.at(plan.masses_g[i]));
  }
  EXPECT_GT(leftmost.size(), 1u);
}

TEST(JudgmentTrial, TakesAnswersOfTheQuestionOnly) {
  Judgment::Block block = block_of({15, 100});
  const TrialPlan plan = plans(block, 7).at(0);
  Judgment::Trial trial(block, plan, 7);
  EXPECT_FALSE(trial.refusal(judge(1)));
  EXPECT_FALSE(trial.refusal(judge(7)));
  EXPECT_THAT(*trial.refusal(judge(8)), HasSubstr("from 1 to 7"));
  EXPECT_TRUE(trial.refusal(judge(2.5)));
  EXPECT_TRUE(trial.refusal(judge(std::nan(""))));
  EXPECT_EQ(trial.n_answers(), 7);
  trial.take(judge(3));
  EXPECT_EQ(trial.result().outcome, "judged");
  EXPECT_EQ(trial.result().value, 3);
  EXPECT_EQ(trial.answer(), "3");

  block.question = number(0.5, 100);
  Judgment::Trial typed(block, plan, 7);
  EXPECT_FALSE(typed.refusal(judge(0.75)));
  EXPECT_TRUE(typed.refusal(judge(0.25)));
  EXPECT_FALSE(typed.n_answers()) << "any number";

  block.question.reset();  // of a log whose texts are lost
  EXPECT_FALSE(Judgment::Trial(block, plan, 7).refusal(judge(1234)));
}

TEST(JudgmentTrial, LogsAChoiceAsItsValueOrItsPlace) {
  Judgment::Block block = block_of({15, 100});
  const TrialPlan plan = plans(block, 7).at(0);
  block.question = choice({"0", "0.5", "-2"});
  Judgment::Trial numbers(block, plan, 7);
  EXPECT_FALSE(numbers.refusal(judge(-2)));
  EXPECT_THAT(*numbers.refusal(judge(1)), HasSubstr("none of the choices 0, 0.5, -2"));
  numbers.take(judge(0.5));
  EXPECT_EQ(numbers.result().outcome, "judged");
  EXPECT_EQ(numbers.result().value, 0.5);
  EXPECT_EQ(numbers.answer(), "0.5");
  EXPECT_EQ(Judgment::number_of(*block.question, "-2"), -2);

  block.question = choice({"same", "different", "1"});
  Judgment::Trial words(block, plan, 7);
  EXPECT_FALSE(words.refusal(judge(3)));
  EXPECT_TRUE(words.refusal(judge(0)));
  EXPECT_TRUE(words.refusal(judge(4)));
  words.take(judge(2));
  EXPECT_EQ(words.result().outcome, "chosen") << "the value is a place";
  EXPECT_EQ(words.answer(), "different");
  EXPECT_EQ(words.n_answers(), 3);
  EXPECT_EQ(Judgment::number_of(*block.question, "1"), 3);
  EXPECT_FALSE(Judgment::asks_for_number(choice({"1", "1.0"}))) << "two choices of one number";
}

TEST(JudgmentBlock, ReadsItsQuestionInTheSessionsLanguage) {
  FormQuestion spoken = likert(1, 7);
  spoken.key = "spoken";
  spoken.kind = QuestionKind::text;
  const std::map<std::string, Questionnaire> forms{{"mine", {"", "", {likert(0, 3), spoken}}}};
  Judgment::Block block = block_of({15, 100});
  block.question.reset();
  TaskBlock asked(block);
  EXPECT_EQ(asked.questionnaire(), "mine");
  EXPECT_TRUE(asked.lacks_question());
  asked.read_question(forms);
  EXPECT_FALSE(asked.lacks_question());
  EXPECT_TRUE(asked.trial(plans(block, 7).at(0), 7)->refusal(judge(4))) << "0 to 3";
  for (const char* name : {"mine.spoken", "mine.other", "other.asked"}) {
    block.asks = name;
    TaskBlock other(block);
    other.read_question(forms);
    EXPECT_TRUE(other.lacks_question()) << name;
  }
}

TEST(JudgmentBlock, KeysAreChecked) {
  const auto keys = [](const Judgment::Block& block) {
    std::vector<std::string> wrong;
    for (const ConfigMistake& mistake : block.check()) wrong.emplace_back(mistake.keys.front());
    return wrong;
  };
  EXPECT_THAT(keys(block_of({100, 100})), IsEmpty()) << "equal cubes can be judged";
  EXPECT_THAT(keys(block_of({100})), IsEmpty());
  EXPECT_THAT(keys(block_of({})), ElementsAre("masses_g"));
  EXPECT_THAT(keys(block_of({}, 2)), ElementsAre("masses_g"));
  EXPECT_THAT(keys(block_of({1, 2, 3, 4, 5, 6, 7})), ElementsAre("masses_g"));
  EXPECT_THAT(keys(block_of({1, 2, 3, 4, 5, 6, 7}, 2)), IsEmpty());
  EXPECT_THAT(keys(block_of({100}, 2)), ElementsAre("cubes"));
  EXPECT_THAT(keys(block_of(Masses(40, 100), 2)), ElementsAre("cubes")) << "780 pairs";
  Judgment::Block block = block_of({15, 100}, 1);
  block.table_friction = {0.2};
  EXPECT_THAT(keys(block), ElementsAre("table_friction"));
  block = block_of({15, 100}, 1);
  block.trials = {{"C2", 251}};
  EXPECT_THAT(keys(block), ElementsAre("trials")) << "502 trials";
  block.trials = {{"C2", 0}};
  EXPECT_THAT(keys(block), ElementsAre("trials"));
  for (const char* name : {"", "mine", "mine.", ".asked"}) {
    block = block_of({15, 100});
    block.asks = name;
    EXPECT_THAT(keys(block), ElementsAre("question")) << name;
  }
}

TEST(Judgment, SimulatedNumbersIncreaseWithTheHeavinessOfOneCube) {
  double before = -1;
  for (const double lag_mm : {0.0, 2.0, 10.0, 50.0, 100.0}) {
    const double given = simulated(number(0, 500), {lag_mm});
    EXPECT_GT(given, before);
    before = given;
  }
  EXPECT_EQ(before, 500);
  EXPECT_EQ(simulated(likert(1, 7), {0}), 1);
  EXPECT_EQ(simulated(likert(1, 7), {1000}), 7);
  EXPECT_EQ(simulated(choice({"0", "0.5", "10"}), {2}), 0.5) << "the nearest number";
}

TEST(Judgment, SimulatedNumbersOfSeveralCubesAreTheirDifference) {
  EXPECT_EQ(simulated(likert(1, 7), {40, 40, 40}), 1);
  EXPECT_EQ(simulated(likert(1, 7), {40, 140}), 7);
  EXPECT_EQ(simulated(likert(1, 7), {140, 60, 40}), 7);
  EXPECT_EQ(simulated(number(0, 500), {30, 40}), simulated(number(0, 500), {10}));
}

TEST(Judgment, SimulatedChoicesAreTheHeaviestCubeOrRandom) {
  const FormQuestion place = choice({"left", "middle", "right"});
  EXPECT_EQ(simulated(place, {3, 1, 2}), 1);
  EXPECT_EQ(simulated(place, {1, 2, 3}), 3);
  std::set<double> given;
  RandomStream stream(1, "answers");
  for (int i = 0; i < 60; ++i)
    given.insert(*Judgment::simulated({place}, {.remembered_mm = {1, 2}}, stream).actions[0].value);
  EXPECT_EQ(given, (std::set<double>{1, 2, 3})) << "no model knows what is asked of two cubes";
}

TEST(Judgment, LapsesAndBlindAnswersAreUniform) {
  std::map<double, int> lapses, blind;
  RandomStream stream(1, "answers");
  const FormQuestion asked = likert(0, 3);
  constexpr int n = 4000;
  for (int i = 0; i < n; ++i) {
    ++lapses[simulated(asked, {stream.uniform(), 0.5}, true)];
    ++blind[*Judgment::blind({asked}, {2}, stream).actions[0].value];
  }
  for (const auto* counts : {&lapses, &blind}) {
    EXPECT_THAT(*counts, SizeIs(4));
    for (const auto& [value, times] : *counts) EXPECT_NEAR(times, n / 4, 150) << value;
  }
  EXPECT_EQ(simulated(choice({"a", "b"}), {0.99}, true), 2);
}

TEST(Judgment, FullestScreensHaveEachKindOfQuestionThatIsAnsweredOnThem) {
  std::set<QuestionKind> kinds;
  for (const ScreenState& screen : Judgment::fullest_screens())
    kinds.insert(std::any_cast<const Judgment::Offer&>(screen.offer).question.kind);
  EXPECT_THAT(kinds, ElementsAre(QuestionKind::choice, QuestionKind::likert, QuestionKind::slider,
                                 QuestionKind::number));
}

}  // namespace
}  // namespace heft
