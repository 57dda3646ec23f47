// Mistakes that configurations of procedures find without a file.
#include <gmock/gmock.h>

#include <limits>

#include "psychophysics/Interleaving.h"
#include "psychophysics/ProcedureKinds.h"
#include "psychophysics/Staircases.h"

namespace heft {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

template <typename Config>
std::vector<std::string> mistakes_of(const Config& config) {
  std::vector<std::string> texts;
  for (const ConfigMistake& mistake : config.check()) texts.push_back(mistake.text());
  return texts;
}

TEST(Config, OfThePaperIsValid) {
  EXPECT_THAT(mistakes_of(test::paper_15g()), IsEmpty());
  EXPECT_THAT(mistakes_of(ConstantConfig{.levels = {-5, 0, 5}}), IsEmpty());
  EXPECT_THAT(mistakes_of(InterleaveConfig{}), IsEmpty());
}

TEST(Config, OfAnUpDownNamesEachMistake) {
  const UpDownConfig good = test::paper_15g();
  const auto changed = [&](auto change) {
    UpDownConfig config = good;
    change(config);
    return mistakes_of(config);
  };
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(changed([](auto& c) { c.start = nan; }),
              ElementsAre("start is nan, expected a finite number"));
  EXPECT_THAT(changed([](auto& c) { c.start = -1; }),
              ElementsAre("start is -1, expected at least the floor 0"));
  EXPECT_THAT(changed([](auto& c) { c.ceiling = 100; }),
              ElementsAre("start is 175, expected at most the ceiling 100"));
  EXPECT_THAT(changed([](auto& c) { c.ceiling = 0; }),
              ElementsAre("floor is 0, expected below the ceiling 0"));
  EXPECT_THAT(changed([](auto& c) { c.ceiling = 175; }), IsEmpty());
  EXPECT_THAT(changed([](auto& c) { c.floor = 175; }), IsEmpty());
  EXPECT_THAT(changed([](auto& c) { c.step.reset(); }),
              ElementsAre(R"(lacks "step" or "steps", expected one of them)"));
  EXPECT_THAT(changed([](auto& c) { c.step = 0; }), ElementsAre(HasSubstr("step is 0")));
  EXPECT_THAT(changed([](auto& c) { c.min_step = 51; }),
              ElementsAre("min_step is 51, expected at most the step 50"));
  EXPECT_THAT(changed([](auto& c) { c.min_step = 50; }), IsEmpty());
  EXPECT_THAT(changed([](auto& c) {
                c.steps = {50, 25};
              }),
              ElementsAre(HasSubstr("step together with steps"),
                          HasSubstr("halve_every together with steps")));
  EXPECT_THAT(changed([](auto& c) { c.up = 0; }),
              ElementsAre("up is 0, expected a whole number, at least 1"));
  EXPECT_THAT(changed([](auto& c) { c.down = -2; }), ElementsAre(HasSubstr("down is -2")));
  EXPECT_THAT(changed([](auto& c) { c.halve_every = -1; }), ElementsAre(HasSubstr("halve_every")));
  EXPECT_THAT(changed([](auto& c) { c.discard_reversals = 10; }),
              ElementsAre(HasSubstr("leaves no reversal for the estimate")));
  EXPECT_THAT(changed([](auto& c) { c.discard_reversals = 9; }), IsEmpty());
  EXPECT_THAT(changed([](auto& c) { c.min_trials = 201; }),
              ElementsAre("min_trials is 201, expected at most stop_trials 200"));
  EXPECT_THAT(changed([](auto& c) { c.min_trials = 200; }), IsEmpty());
  EXPECT_THAT(changed([](auto& c) { c.step_scale = StepScale::db, c.step = 201; }),
              ElementsAre("step is 201, expected a number above 0 and at most 200"));
  EXPECT_THAT(changed([](auto& c) { c.step_scale = StepScale::log10, c.step = 10; }), IsEmpty());
  EXPECT_THAT(changed([](auto& c) { c.step_scale = StepScale::db, c.start = 0; }),
              ElementsAre(HasSubstr("start is 0, expected a number above 0")));
}

TEST(Config, SaysWhichValueOfAListIsWrong) {
  const ConfigMistakes found = test::listed_steps(10, {4, -2, 0}).check();
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].index, 1u);
  EXPECT_EQ(found[1].index, 2u);
  EXPECT_THAT(found[0].keys, ElementsAre("steps"));
}

TEST(Config, OfConstantStimuliNamesEachMistake) {
  EXPECT_THAT(mistakes_of(ConstantConfig{}),
              ElementsAre("levels has 0 numbers, expected at least 1"));
  EXPECT_THAT(mistakes_of(ConstantConfig{.levels = {5, 1, 5}}),
              ElementsAre(HasSubstr("levels has 5 twice")));
  EXPECT_EQ(ConstantConfig({.levels = {5, 1, 5}}).check()[0].index, 2u);
  EXPECT_THAT(mistakes_of(ConstantConfig{.levels = {5}, .n_per_level = 0}),
              ElementsAre(HasSubstr("n_per_level is 0")));
  EXPECT_THAT(mistakes_of(ConstantConfig{.levels = {5, 6}, .n_per_level = 5001}),
              ElementsAre(HasSubstr("10002 trials")));
  EXPECT_THAT(mistakes_of(ConstantConfig{.levels = {5, 6}, .n_per_level = 5000}), IsEmpty());
}

TEST(Config, ThatIsInvalidMakesNoProcedure) {
  try {
    const Procedure procedure("s", UpDownConfig{.start = -1, .up = 0, .floor = 0});
    FAIL();
  } catch (const InvalidConfig& error) {
    EXPECT_EQ(error.mistakes().size(), 3u);
    EXPECT_THAT(error.what(), AllOf(HasSubstr("up_down: up is 0"), HasSubstr("lacks \"step\""),
                                    HasSubstr("at least the floor 0")));
  }
  EXPECT_THROW(UpDown(UpDownConfig{}), InvalidConfig);
  EXPECT_THROW(Constant(ConstantConfig{}), InvalidConfig);
}

TEST(Config, OfInterleavingIsCheckedWhereItIsUsed) {
  RandomStream stream(1, "interleave");
  const std::vector<Procedure> staircases{{"s", test::paper_15g()}};
  EXPECT_THROW(next_staircase(staircases, {.max_lag = -1}, {}, stream), InvalidConfig);
}

TEST(Config, KeepsAComparisonFromWeighingNothing) {
  const UpDownConfig paper = test::paper_15g();
  EXPECT_THAT(paper.check_beside(15), IsEmpty());
  UpDownConfig config = paper;
  config.floor = -5;
  EXPECT_EQ(config.check_beside(15).size(), 1u);
  config.floor.reset();
  EXPECT_EQ(config.check_beside(15).size(), 1u);
  config.step_scale = StepScale::db;
  EXPECT_THAT(config.check_beside(15), IsEmpty());
  const ConstantConfig constant{.levels = {-15, -14, 20}};
  UpDownConfig signed_levels{.start = 5, .step = 2, .floor = -10};
  EXPECT_THAT(signed_levels.check_beside(15, true), IsEmpty());
  signed_levels.floor = -15;
  EXPECT_EQ(signed_levels.check_beside(15, true).size(), 1u);
  signed_levels.floor.reset();
  EXPECT_EQ(signed_levels.check_beside(15, true).size(), 1u);
  ASSERT_EQ(constant.check_beside(15).size(), 1u);
  EXPECT_EQ(constant.check_beside(15)[0].index, 0u);
}

TEST(Config, IsReportedByItsKeys) {
  EXPECT_EQ(ProcedureKinds::described(Procedure("s", test::paper_15g())),
            "floor 0 g, ceiling none, 1 up, 1 down, step changes before_move, ends after 10 "
            "reversals, at most 200 trials, first 2 reversals left out");
  EXPECT_EQ(ProcedureKinds::described(
                Procedure("s", ConstantConfig{.levels = {-5, 2.5}, .n_per_level = 3})),
            "constant levels -5, 2.5 g, each 3 times, order blocks");
}

}  // namespace
}  // namespace heft
