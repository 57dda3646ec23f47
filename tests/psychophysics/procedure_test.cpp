// Procedure: each kind behaves as without the wrapper.
#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include "psychophysics/ProcedureKinds.h"
#include "psychophysics/Staircases.h"

namespace heft {
namespace {

using testing::ElementsAre;
using testing::Optional;

TEST(Procedure, KindsHaveTheirNamesInFiles) {
  EXPECT_EQ(ProcedureKinds::names.front(), "up_down");  // of a file that names none
  for (std::size_t i = 0; i < ProcedureKinds::names.size(); ++i)
    EXPECT_EQ(ProcedureKinds::defaults(ProcedureKinds::names[i]).index(), i);
}

RC_GTEST_PROP(ProcedureProperty, UpDownIsTheStaircaseItself, ()) {
  const UpDownConfig config = *test::any_staircase();
  UpDown alone(config);
  Procedure procedure("s", config);
  RC_ASSERT(procedure.name() == "s");
  RC_ASSERT(!procedure.planned_trials());
  while (!alone.finished()) {
    RC_ASSERT(!procedure.finished());
    const double level =
        procedure.next_level(RandomStream(*rc::gen::arbitrary<std::uint64_t>(), ""));
    RC_ASSERT(level == alone.level());
    const bool positive = *rc::gen::arbitrary<bool>();
    const Update expected = alone.respond(positive);
    const Update update = procedure.respond({positive}, level);
    RC_ASSERT(update.finish == expected.finish);
    RC_ASSERT(update.reversal.has_value() == expected.reversal.has_value());
    if (update.reversal) RC_ASSERT(update.reversal->level == expected.reversal->level);
    RC_ASSERT(procedure.n_trials() == alone.n_trials());
  }
  const std::vector<Estimate> estimates = procedure.estimates();
  RC_ASSERT(estimates.size() == 1u);
  RC_ASSERT(estimates[0].method == "mean_of_reversals");
  RC_ASSERT(estimates[0].value == alone.estimate());
  RC_ASSERT(estimates[0].n_trials == alone.n_trials());
  RC_ASSERT(estimates[0].n_reversals == static_cast<int>(alone.reversals().size()));
  RC_ASSERT(estimates[0].n_floor == alone.n_floor());
  RC_ASSERT(estimates[0].n_ceiling == alone.n_ceiling());
}

TEST(Procedure, AnyChoiceIsPositive) {
  EXPECT_TRUE(response_of(Choice::comparison).positive);
  EXPECT_TRUE(response_of(Choice::reference).positive);
  EXPECT_FALSE(response_of(Choice::none).positive);
  EXPECT_THAT(response_of(Choice::reference).choice, Optional(Choice::reference));
}

TEST(Procedure, ShowsWhatItPlans) {
  EXPECT_THAT(Procedure("s", test::paper_15g()).planned_levels(), ElementsAre(175));
  const Procedure constant("s", ConstantConfig{.levels = {5, -5, 20}, .n_per_level = 7});
  EXPECT_THAT(constant.planned_levels(), ElementsAre(5, -5, 20));
  EXPECT_THAT(constant.planned_trials(), Optional(21));
}

Censored censored(const UpDownConfig& config, std::string_view answers) {
  Procedure procedure("s", config);
  for (char sign : answers)
    if (!procedure.finished())
      procedure.respond({sign == '+'}, procedure.next_level(RandomStream(1, "")));
  return procedure.estimates().front().censored;
}

TEST(Censoring, IsNoneWhereTheReversalsThatCountKeepAwayFromTheBounds) {
  EXPECT_EQ(censored(test::paper_15g(), "+++-+-+-+-+-+-+-"), Censored::none);
  // It reaches the floor early, but the reversals in the estimate are above it.
  EXPECT_EQ(censored({.start = 10, .step = 10, .floor = 0, .stop_reversals = 4}, "++----+-+-+"),
            Censored::none);
}

/// The paper's staircase for 200 g (its table 2), whose steps lead to 0 exactly.
const UpDownConfig paper_200g{.start = 600, .step = 150, .halve_every = 2, .floor = 0};

TEST(Censoring, IsNoneWhereAStepEndsOnTheBoundExactly) {
  UpDown staircase(paper_200g);
  const test::Trace trace = test::answer(staircase, "++++-++-+-+-+-+");
  // The third reversal, at 0, counts.
  EXPECT_THAT(trace.reversal_levels, ElementsAre(0, 150, 0, 75, 37.5, 75, 56.25, 75, 65.625, 75));
  EXPECT_EQ(staircase.n_floor(), 0);
  EXPECT_EQ(staircase.estimates().front().censored, Censored::none);
  EXPECT_EQ(staircase.estimate(), 459.375 / 8);
  const UpDownConfig upwards{.start = -600, .step = 150, .halve_every = 2, .ceiling = 0};
  EXPECT_EQ(censored(upwards, "----+--+-+-+-+-"), Censored::none);
}

TEST(Censoring, IsToTheSideWhereABoundCutAMoveToAReversalThatCounts) {
  // As above, but at 0 a difference is seen once more.
  EXPECT_EQ(censored(paper_200g, "++++-+++-+-+-+-+"), Censored::below);
  const UpDownConfig upwards{.start = -600, .step = 150, .halve_every = 2, .ceiling = 0};
  EXPECT_EQ(censored(upwards, "----+---+-+-+-+-"), Censored::above);
  const UpDownConfig both{.start = 0, .step = 10, .floor = 0, .ceiling = 15, .stop_reversals = 4};
  EXPECT_EQ(censored(both, "--+--+-"), Censored::above);  // 15 was to be 20, twice
  EXPECT_EQ(censored(both, "-+-++-"), Censored::below);   // 0 was to be -10
  EXPECT_EQ(censored(both, "-+--+++-"), Censored::indeterminate);
}

TEST(Censoring, IsNoneWhereOnlyDiscardedReversalsWereCut) {
  EXPECT_EQ(censored(paper_200g, "++++++-+-+-+-+-+"), Censored::none);
}

TEST(Censoring, IsByTheInnerLevelWhereOnlyWhatIsShownStaysAtTheBound) {
  UpDownConfig config{.start = 5, .step = 10, .floor = 0, .stop_reversals = 3};
  config.at_bound = AtBound::virtual_level;
  // Inner levels 5 -5 -15 -5 -15: that of the third reversal is beyond the floor.
  EXPECT_EQ(censored(config, "++-+-"), Censored::below);
}

TEST(Censoring, IsToTheSideOfABoundThatMadeTheReversal) {
  const UpDownConfig config{
      .start = 20, .step = 10, .floor = 0, .bound_is_reversal = true, .stop_reversals = 3};
  // 20 10 0 10 0: the third reversal is a move from 0 that the floor cut.
  EXPECT_EQ(censored(config, "++-++"), Censored::below);
}

TEST(Censoring, IsNoneWhereOnlyRoundingIsBeyondTheBound) {
  UpDownConfig config{.start = 0.1, .step = 0.1, .ceiling = 0.3, .stop_reversals = 1};
  config.discard_reversals = 0;
  ASSERT_GT(0.1 + 0.1 + 0.1, 0.3);
  EXPECT_EQ(censored(config, "--+"), Censored::none);
}

// Logs before version 6.
TEST(Censoring, ByTheOlderRuleIsToTheSideWhereReversalsStandAtABound) {
  const auto older = [](UpDownConfig config, std::string_view answers) {
    config.censoring = CensoringRule::levels_at_bounds;
    return censored(config, answers);
  };
  EXPECT_EQ(older(paper_200g, "++++-++-+-+-+-+"), Censored::below);
  EXPECT_EQ(older({.start = 0, .step = 10, .floor = 0, .stop_reversals = 4}, "+-+-+-+-"),
            Censored::below);
  EXPECT_EQ(older({.start = 0, .step = 10, .ceiling = 0, .stop_reversals = 4}, "-+-+-+-+"),
            Censored::above);
  EXPECT_EQ(
      older({.start = 0, .step = 10, .floor = 0, .ceiling = 10, .stop_reversals = 4}, "-+-+-+-+"),
      Censored::indeterminate);
  EXPECT_EQ(older(test::paper_15g(), "+++-+-+-+-+-+-+-"), Censored::none);
}

TEST(Censoring, IsToTheSideWhereSomebodyAlwaysAnswersAlike) {
  const UpDownConfig config{.start = 5, .step = 1, .floor = 0, .ceiling = 9, .stop_trials = 20};
  EXPECT_EQ(censored(config, std::string(20, '+')), Censored::below);
  EXPECT_EQ(censored(config, std::string(20, '-')), Censored::above);
}

TEST(Censoring, IsUnsettledWhereTheTrialsRanOutFirst) {
  // At the floor, but not yet cut there.
  EXPECT_EQ(censored({.start = 2, .step = 1, .floor = 0, .stop_trials = 3}, "+++"),
            Censored::indeterminate);
  EXPECT_EQ(censored({.start = 5, .step = 1, .stop_trials = 5}, "+++++"), Censored::indeterminate);
  EXPECT_EQ(censored({.start = 5, .step = 1, .stop_trials = 6}, "+-+-+-"), Censored::indeterminate);
}

}  // namespace
}  // namespace heft
