// Files of Bayesian procedures: the forms of a grid, defaults, and mistakes at their places.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "EditedFile.h"
#include "protocol/Protocol.h"
#include "protocol/readers/Files.h"
#include "psychophysics/Interleaving.h"
#include "psychophysics/ProcedureKinds.h"
#include "tasks/Comparison.h"

namespace heft {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::ElementsAreArray;
using testing::IsEmpty;

const std::string bayesian_file = R"([[staircase]]
name = "psi"
kind = "psi"
function = "cumulative_normal"
levels = { from = 0, to = 1, step = 0.1 }
threshold = [0.1, 0.2, 0.4]
slope = { from = 1, to = 100, n = 3, spacing = "log" }
guess = { from = 0, to = 0.5, n = 3 }
lapse = 0.02
nuisance = ["guess", "lapse"]
start = 0.35
floor = 0.1
ceiling = 0.9
stop_trials = 60
stop_ci_width = 0.25
[[staircase]]
name = "quest"
kind = "quest"
guess = -1
guess_sd = 2
placement = "mean"
range = 4
stop_trials = 40
[[staircase]]
name = "choice"
kind = "quest_plus"
function = "indecision"
levels = [-10, 10]
sensitivity = [0.1, 0.2]
indecision = 1
bias = 0
lapse = 0
stop_trials = 30
)";

TEST(BayesianFile, ReadsEveryKey) {
  const auto staircases = parse_procedure(bayesian_file, "f").staircases;
  const PsiConfig& psi = staircases.at(0).get_if<Psi>()->config();
  EXPECT_EQ(psi.function, ResponseFunction::cumulative_normal);
  ASSERT_EQ(psi.levels.values.size(), 11u);
  for (int i = 0; i <= 10; ++i)
    EXPECT_NEAR(psi.levels.values[static_cast<std::size_t>(i)], 0.1 * i, 1e-15);
  EXPECT_THAT(psi.threshold.values, ElementsAre(0.1, 0.2, 0.4));
  EXPECT_THAT(psi.slope.values, ElementsAre(1, DoubleNear(10, 1e-12), 100));
  EXPECT_THAT(psi.guess.values, ElementsAre(0, 0.25, 0.5));
  EXPECT_THAT(psi.lapse.values, ElementsAre(0.02));
  EXPECT_THAT(psi.nuisance, ElementsAre("guess", "lapse"));
  EXPECT_EQ(psi.start, 0.35);
  EXPECT_EQ(psi.stop_trials, 60);
  EXPECT_EQ(psi.stop_ci_width, 0.25);
  EXPECT_EQ(psi.space().levels.size(), 9u);  // between floor and ceiling
  const QuestConfig& quest = staircases.at(1).get_if<Quest>()->config();
  EXPECT_EQ(quest.guess, -1);
  EXPECT_EQ(quest.guess_sd, 2);
  EXPECT_EQ(quest.placement, QuestPlacement::mean);
  EXPECT_EQ(quest.half_size(), 200);
  EXPECT_EQ(quest.p_threshold, 0.82);  // as the authors' program documents
  EXPECT_EQ(quest.beta, 3.5);
  EXPECT_EQ(quest.delta, 0.01);
  EXPECT_EQ(quest.gamma, 0.5);
  const QuestPlusConfig& choice = staircases.at(2).get_if<QuestPlus>()->config();
  EXPECT_TRUE(choice.is_indecision());
  EXPECT_THAT(choice.threshold.values, IsEmpty());
  EXPECT_FALSE(choice.stop_ci_width);
}

class BrokenBayesian : public testing::TestWithParam<Broken> {};

TEST_P(BrokenBayesian, IsOneMistakeAtItsPlace) {
  expect_broken(bayesian_file, GetParam(), [](auto& text) { parse_procedure(text, "x.toml"); });
}

const std::vector<Broken> broken_bayesian{
    {"no_function",
     {"[[staircase]]\nname = \"choice\"\nkind = \"quest_plus\"\nfunction = \"indecision\"",
      "^[[staircase]]\nname = \"choice\"\nkind = \"quest_plus\""},
     {"lacks", "\"function\""}},
    {"no_parameter",
     {"\"cumulative_normal\"\nlevels = { from = 0, to = 1, step = 0.1 }\nthreshold = [0.1, 0.2, "
      "0.4]",
      "^\"cumulative_normal\"\nlevels = { from = 0, to = 1, step = 0.1 }"},
     {"[[staircase]] lacks \"threshold\"", "function \"cumulative_normal\""}},
    {"misspelled_function", {"\"indecision\"", "^\"indecison\""}, {"did you mean \"indecision\""}},
    {"unknown_function",
     {"\"cumulative_normal\"", "^\"normal\""},
     {"function is \"normal\"", "\"cumulative_normal\"", "\"indecision\""}},
    {"text_as_grid",
     {"lapse = 0.02", "lapse = ^\"0.02\""},
     {"lapse is \"0.02\"", "a number, numbers in brackets, {from, to, step}"}},
    {"descending", {"[0.1, 0.2, 0.4]", "[0.1, ^0.05, 0.4]"}, {"0.05 after 0.1", "ascending"}},
    {"grid_without_spacing",
     {"guess = { from = 0, to = 0.5, n = 3 }", "guess = ^{ from = 0, to = 0.5 }"},
     {"guess needs \"step\" or \"n\""}},
    {"grid_without_an_end",
     {"{ from = 0, to = 0.5, n = 3 }", "^{ from = 0, n = 3 }"},
     {"[staircase.guess] lacks \"to\""}},
    {"backward_grid", {"to = 0.5", "to = ^-0.5"}, {"to is -0.5", "at least 0"}},
    {"empty_grid", {"from = 0, to = 1,", "from = 1, to = ^1,"}, {"to is 1", "above from 1"}},
    {"tiny_step", {"step = 0.1", "step = ^1e-8"}, {"more than 10000 values"}},
    {"ratios_from_zero", {"slope = { from = 1", "slope = { from = ^0"}, {"from is 0", "above 0"}},
    {"parameter_of_another_function",
     {"bias = 0\n", "bias = 0\nslope = ^3\n"},
     {"slope together with function \"indecision\"", "\"sensitivity\""}},
    {"lapse_beyond_guess",
     {"lapse = 0.02", "lapse = ^0.5"},
     {"guess and lapse reach 0.5 and 0.5", "a sum below 1"}},
    {"fixed_with_a_width",
     {"sensitivity = [0.1, 0.2]", "sensitivity = 0.1\nstop_ci_width = ^5"},
     {"stop_ci_width with a fixed sensitivity"}},
    {"no_such_nuisance",
     {"[\"guess\", \"lapse\"]", "[\"guess\", ^\"laps\"]"},
     {"nuisance has \"laps\"", "\"lapse\""}},
    {"nothing_between_bounds",
     {"start = 0.35\nfloor = 0.1\nceiling = 0.9", "floor = ^0.81\nceiling = 0.89"},
     {"no level is between"}},
    {"fixed_threshold", {"[0.1, 0.2, 0.4]", "^0.2"}, {"threshold has one value", "quest_plus"}},
    {"start_beyond_bounds", {"start = 0.35", "start = ^0.95"}, {"start is 0.95", "ceiling"}},
    {"no_trials", {"stop_trials = 60", "stop_trials = ^0"}, {"stop_trials is 0"}},
    {"p_below_gamma",
     {"placement = \"mean\"", "p_threshold = ^0.5"},
     {"p_threshold is 0.5", "0.5 and 0.995"}},
    {"too_many_grains", {"range = 4", "range = ^4000"}, {"range is 4000", "20000 grains"}},
};
INSTANTIATE_TEST_SUITE_P(File, BrokenBayesian, testing::ValuesIn(broken_bayesian),
                         [](const auto& each) { return each.param.name; });

TEST(BayesianFile, TheExampleIsAProtocolOfThreeWayChoices) {
  const Protocol protocol = load_protocol(shipped_path("examples/psi"));
  const auto* block = block_as<Comparison::Block>(protocol.blocks.back());
  ASSERT_TRUE(block);
  const Psi* psi = block->staircases.at(0).staircase.get_if<Psi>();
  ASSERT_TRUE(psi);
  EXPECT_TRUE(psi->config().is_indecision());
  EXPECT_LT(psi->config().levels.values.front(), 0);
}

}  // namespace
}  // namespace heft
