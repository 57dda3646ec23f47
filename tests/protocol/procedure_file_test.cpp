#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "EditedFile.h"
#include "protocol/readers/Files.h"
#include "psychophysics/Interleaving.h"
#include "psychophysics/ProcedureKinds.h"

namespace heft {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const std::string procedure_file = R"(seed = 42
interleave = "round_robin"
max_lag = 3
[[staircase]]
name = "15g"
kind = "up_down"
start = 175.0
step = 50
halve_every = 2
min_step = 5
step_scale = "linear"
up = 1
down = 2
initial_1up1down = true
floor = 0.0
ceiling = 1500.0
at_bound = "virtual"
bound_is_reversal = true
change_step = "after_move"
stop_reversals = 8
min_trials = 4
stop_trials = 90
discard_reversals = 3
[[staircase]]
name = "lists"
start = 20
steps = [8, 4.5, 2]
steps_up = [3]
change_after_trials = [5, 12]
step_scale = "db"
)";

TEST(ProcedureFile, ReadsEveryKey) {
  const InterleavedProcedures config = parse_procedure(procedure_file, "all.toml");
  EXPECT_EQ(config.seed, 42u);
  EXPECT_EQ(config.interleaving.interleave, Interleave::round_robin);
  EXPECT_EQ(config.interleaving.max_lag, 3);
  ASSERT_EQ(config.staircases.size(), 2u);
  EXPECT_EQ(config.staircases[0].name(), "15g");
  const auto& first = config.staircases[0].get_if<UpDown>()->config();
  EXPECT_EQ(first.start, 175);
  EXPECT_EQ(first.step, 50);
  EXPECT_EQ(first.halve_every, 2);
  EXPECT_EQ(first.min_step, 5);
  EXPECT_EQ(first.up, 1);
  EXPECT_EQ(first.down, 2);
  EXPECT_TRUE(first.initial_1up1down);
  EXPECT_EQ(first.floor, 0);
  EXPECT_EQ(first.ceiling, 1500);
  EXPECT_EQ(first.at_bound, AtBound::virtual_level);
  EXPECT_TRUE(first.bound_is_reversal);
  EXPECT_EQ(first.change_step, ChangeStep::after_move);
  EXPECT_EQ(first.stop_reversals, 8);
  EXPECT_EQ(first.min_trials, 4);
  EXPECT_EQ(first.stop_trials, 90);
  EXPECT_EQ(first.discard_reversals, 3);
  const auto& second = config.staircases[1].get_if<UpDown>()->config();
  EXPECT_THAT(second.steps, ElementsAre(8, 4.5, 2));
  EXPECT_THAT(second.steps_up, ElementsAre(3));
  EXPECT_THAT(second.change_after_trials, ElementsAre(5, 12));
  EXPECT_EQ(second.step_scale, StepScale::db);
}

TEST(ProcedureFile, MissingKeysHaveTheDocumentedDefaults) {
  const InterleavedProcedures config =
      parse_procedure("[[staircase]]\nname = \"a\"\nstart = 10\nstep = 2\n", "short.toml");
  EXPECT_EQ(config.interleaving.interleave, Interleave::random);
  EXPECT_EQ(config.interleaving.max_lag, 0);
  const auto& staircase = config.staircases.at(0).get_if<UpDown>()->config();
  EXPECT_EQ(staircase.up, 1);
  EXPECT_EQ(staircase.down, 1);
  EXPECT_EQ(staircase.halve_every, 0);
  EXPECT_EQ(staircase.step_scale, StepScale::linear);
  EXPECT_FALSE(staircase.initial_1up1down);
  EXPECT_FALSE(staircase.floor);
  EXPECT_FALSE(staircase.ceiling);
  EXPECT_EQ(staircase.at_bound, AtBound::clamp);
  EXPECT_FALSE(staircase.bound_is_reversal);
  EXPECT_EQ(staircase.change_step, ChangeStep::before_move);
  EXPECT_EQ(staircase.stop_reversals, 10);
  EXPECT_EQ(staircase.min_trials, 0);
  EXPECT_EQ(staircase.stop_trials, 200);
  EXPECT_EQ(staircase.discard_reversals, 2);
}

TEST(ProcedureFile, AcceptsTheLargestSeed) {
  const auto file = edited(procedure_file, {"seed = 42", "seed = 9223372036854775807"});
  EXPECT_EQ(parse_procedure(file.text, "f").seed, 9223372036854775807u);
}

TEST(ProcedureFile, AcceptsUtf8WithWindowsLineEnds) {
  const std::string text =
      "# größe\r\n[[staircase]]\r\nname = \"große Stufe\"\r\nstart = 1\r\nstep = 1\r\n";
  EXPECT_EQ(parse_procedure(text, "f").staircases.at(0).name(), "große Stufe");
}

class BrokenProcedure : public testing::TestWithParam<Broken> {};

TEST_P(BrokenProcedure, IsOneMistakeAtItsPlace) {
  expect_broken(procedure_file, GetParam(), [](auto& text) { parse_procedure(text, "x.toml"); });
}

const std::vector<Broken> broken_procedures{
    {"unknown_key", {"floor = 0.0", "^flor = 0.0"}, {"flor", "[[staircase]]", "\"floor\""}},
    {"unknown_top_key", {"max_lag = 3", "^maxlag = 3"}, {"maxlag", "\"max_lag\""}},
    {"unlike_any_key", {"max_lag = 3", "^zzzzzzzz = 3"}, {"\"interleave\"", "\"max_lag\""}},
    {"misspelled_required_key", {"start = 175.0", "^strat = 175.0"}, {"strat", "\"start\""}},
    {"missing_start",
     {"[[staircase]]\nname = \"15g\"\nkind = \"up_down\"\nstart = 175.0",
      "^[[staircase]]\nname = \"15g\""},
     {"lacks", "start"}},
    {"missing_name", {"[[staircase]]\nname = \"lists\"", "^[[staircase]]"}, {"lacks", "name"}},
    {"missing_step",
     {"[[staircase]]\nname = \"lists\"\nstart = 20\nsteps = [8, 4.5, 2]",
      "^[[staircase]]\nname = \"lists\"\nstart = 20"},
     {"lacks", "\"step\" or \"steps\""}},
    {"empty_name", {"\"15g\"", "^\"\""}, {"name", "not empty"}},
    {"number_as_name", {"\"15g\"", "^15"}, {"name is 15", "text in quotes"}},
    {"text_as_number", {"175.0", "^\"175\""}, {"start is \"175\"", "a number"}},
    {"not_a_number", {"175.0", "^nan"}, {"start is nan", "finite"}},
    {"infinity", {"1500.0", "^inf"}, {"ceiling is inf", "finite"}},
    {"float_beyond_doubles", {"1500.0", "^1e999"}, {"ceiling is 1e999", "not beyond"}},
    {"huge_number", {"1500.0", "^1e200"}, {"ceiling is 1e+200", "not beyond"}},
    {"float_as_integer", {"up = 1", "up = ^1.0"}, {"up is 1.0", "whole number, at least 1"}},
    {"zero_up", {"up = 1", "up = ^0"}, {"up is 0", "at least 1"}},
    {"negative_down", {"down = 2", "down = ^-2"}, {"down is -2", "at least 1"}},
    {"integer_beyond_int",
     {"stop_trials = 90", "stop_trials = ^9000000000"},
     {"9000000000", "from 1 to 2147483647"}},
    {"integer_beyond_64_bits",
     {"seed = 42", "seed = ^9223372036854775808"},
     {"9223372036854775808", "from 0 to 9223372036854775807"}},
    {"negative_seed", {"seed = 42", "seed = ^-1"}, {"seed is -1", "at least 0"}},
    {"float_seed", {"seed = 42", "seed = ^42.5"}, {"seed is 42.5", "whole number"}},
    {"integer_as_truth", {"bound_is_reversal = true", "bound_is_reversal = ^1"}, {"true or false"}},
    {"date", {"min_step = 5", "min_step = ^2024-05-01"}, {"a date or time", "a number"}},
    {"table_for_number", {"min_step = 5", "min_step = ^{a = 1}"}, {"a table", "a number"}},
    {"step_zero", {"step = 50", "step = ^0"}, {"step is 0", "above 0"}},
    {"step_negative", {"step = 50", "step = ^-50"}, {"step is -50", "above 0"}},
    {"zero_among_steps", {"4.5", "^0"}, {"steps is 0", "above 0"}},
    {"no_steps", {"[8, 4.5, 2]", "^[]"}, {"0 numbers", "at least 1"}},
    {"no_steps_up", {"[3]", "^[]"}, {"steps_up", "at least 1"}},
    {"steps_without_brackets", {"[8, 4.5, 2]", "^8"}, {"steps is 8", "brackets"}},
    {"step_beside_steps", {"start = 20", "start = 20\nstep = ^4"}, {"step together with steps"}},
    {"halving_beside_steps",
     {"start = 20", "start = 20\nhalve_every = ^2"},
     {"halve_every together with steps"}},
    {"min_step_above_step", {"min_step = 5", "min_step = ^51"}, {"at most the step 50"}},
    {"negative_halving", {"halve_every = 2", "halve_every = ^-2"}, {"at least 0"}},
    {"unknown_kind", {"\"up_down\"", "^\"up_dwon\""}, {"kind is \"up_dwon\"", "\"up_down\""}},
    {"unknown_scale",
     {"\"db\"", "^\"dB\""},
     {"\"linear\", \"db\" or \"log10\"", "did you mean \"db\""}},
    {"unknown_interleave",
     {"\"round_robin\"", "^\"roundrobin\""},
     {"did you mean \"round_robin\""}},
    {"unknown_at_bound", {"\"virtual\"", "^\"virtuel\""}, {"did you mean \"virtual\""}},
    {"unknown_change_step",
     {"\"after_move\"", "^\"later\""},
     {"\"before_move\" or \"after_move\""}},
    {"floor_above_ceiling", {"floor = 0.0", "floor = ^1600"}, {"floor is 1600", "ceiling 1500"}},
    {"start_below_floor", {"start = 175.0", "start = ^-1"}, {"start is -1", "floor 0"}},
    {"start_above_ceiling", {"start = 175.0", "start = ^1501"}, {"start is 1501", "ceiling 1500"}},
    {"db_start_zero", {"start = 20", "start = ^0"}, {"start is 0", "above 0"}},
    {"db_step_of_decades", {"[3]", "[^300]"}, {"steps_up is 300", "at most 200"}},
    {"all_reversals_discarded",
     {"discard_reversals = 3", "discard_reversals = ^8"},
     {"leaves no reversal"}},
    {"stop_within_default_discard",
     {"steps_up = [3]", "stop_reversals = ^2"},
     {"leaves no reversal"}},
    {"changes_that_descend", {"[5, 12]", "[5, ^5]"}, {"has 5", "ascending whole numbers"}},
    {"half_a_trial", {"[5, 12]", "[5, ^12.5]"}, {"has 12.5", "whole numbers"}},
    {"more_steps_than_changes", {"[8, 4.5, 2]", "^[8, 4.5]"}, {"one step more than changes"}},
    {"min_trials_beyond_stop", {"min_trials = 4", "min_trials = ^91"}, {"at most stop_trials 90"}},
    {"same_name", {"\"lists\"", "^\"15g\""}, {"another staircase", "15g", "line 4"}},
    {"staircase_as_table",
     {procedure_file.substr(procedure_file.find("[[staircase]]")),
      "^[staircase]\nname = \"a\"\nstart = 1\nstep = 1\n"},
     {"staircase is a table", "[[staircase]]"}},
    {"no_staircase", {procedure_file, "^seed = 42\n"}, {"lacks \"staircase\""}},
    {"empty_file", {procedure_file, "^"}, {"lacks \"staircase\""}},
    {"syntax", {"up = 1", "up = ^\ndown = nonsense = 4"}, {"not valid TOML", "not checked"}},
    {"key_twice", {"min_step = 5", "min_step = 5\nmin_step = ^6"}, {"not valid TOML", "min_step"}},
};

INSTANTIATE_TEST_SUITE_P(Each, BrokenProcedure, testing::ValuesIn(broken_procedures),
                         name_of_broken);

const std::string constants = R"(seed = 42
[[staircase]]
name = "a"
kind = "constant"
levels = [-20, 0, 20.5]
n_per_level = 4
order = "shuffled"
[[staircase]]
name = "b"
kind = "constant"
levels = [1]
n_per_level = 1
)";

TEST(ProcedureFile, ReadsConstantStimuli) {
  const auto staircases = parse_procedure(constants, "f").staircases;
  ASSERT_EQ(staircases.size(), 2u);
  EXPECT_EQ(staircases[0].name(), "a");
  const auto& first = staircases[0].get_if<Constant>()->config();
  EXPECT_THAT(first.levels, ElementsAre(-20, 0, 20.5));
  EXPECT_EQ(first.n_per_level, 4);
  EXPECT_EQ(first.order, ConstantOrder::shuffled);
  EXPECT_EQ(staircases[1].get_if<Constant>()->config().order, ConstantOrder::blocks);
}

class BrokenConstants : public testing::TestWithParam<Broken> {};

TEST_P(BrokenConstants, IsOneMistakeAtItsPlace) {
  expect_broken(constants, GetParam(), [](auto& text) { parse_procedure(text, "x.toml"); });
}

const std::vector<Broken> broken_constants{
    {"level_twice", {"0, 20.5", "0, ^-20.0"}, {"levels has -20 twice", "different"}},
    {"level_not_finite", {"20.5", "^nan"}, {"levels is nan", "finite"}},
    {"level_infinite", {"20.5", "^-inf"}, {"levels is -inf", "finite"}},
    {"no_levels", {"[-20, 0, 20.5]", "^[]"}, {"0 numbers", "at least 1"}},
    {"level_as_text", {"20.5", "^\"20\""}, {"levels is \"20\"", "a number"}},
    {"levels_without_brackets", {"[-20, 0, 20.5]", "^20"}, {"brackets"}},
    {"levels_missing",
     {"[[staircase]]\nname = \"a\"\nkind = \"constant\"\nlevels = [-20, 0, 20.5]",
      "^[[staircase]]\nname = \"a\"\nkind = \"constant\""},
     {"lacks \"levels\""}},
    {"none_per_level", {"n_per_level = 4", "n_per_level = ^0"}, {"n_per_level is 0", "at least 1"}},
    {"fraction_per_level",
     {"n_per_level = 4", "n_per_level = ^4.5"},
     {"n_per_level is 4.5", "whole number"}},
    {"too_many_trials",
     {"n_per_level = 4", "n_per_level = ^3334"},
     {"10002 trials", "at most 10000"}},
    {"far_too_many_trials", {"n_per_level = 4", "n_per_level = ^2147483647"}, {"at most 10000"}},
    {"n_per_level_missing",
     {"[[staircase]]\nname = \"b\"\nkind = \"constant\"\nlevels = [1]\nn_per_level = 1\n",
      "^[[staircase]]\nname = \"b\"\nkind = \"constant\"\nlevels = [1]\n"},
     {"lacks \"n_per_level\""}},
    {"unknown_order", {"\"shuffled\"", "^\"shuffle\""}, {"did you mean \"shuffled\""}},
    {"misspelled_kind", {"\"constant\"", "^\"constnat\""}, {"did you mean \"constant\""}},
    {"kind_unlike_any", {"\"constant\"", "^\"zzz\""}, {"\"up_down\", \"constant\""}},
    {"key_of_another_kind", {"n_per_level = 4", "n_per_level = 4\n^step = 5"}, {"step"}},
    {"same_name", {"\"b\"", "^\"a\""}, {"another staircase", "line 2"}},
};

INSTANTIATE_TEST_SUITE_P(Each, BrokenConstants, testing::ValuesIn(broken_constants),
                         name_of_broken);

TEST(ProcedureFile, ReportsAllMistakesInOrderAndOnce) {
  const std::string text = R"(sed = 1
seed = 99999999999999999999
[[staircase]]
name = "a"
start = nan
step = 0
up = 0
[[staircase]]
name = "a"
start = 5
floor = 6
steps = [1, -1]
)";
  const auto mistakes = mistakes_of([&] { parse_procedure(text, "x.toml"); });
  std::vector<std::pair<int, int>> places;
  for (const Mistake& mistake : mistakes)
    places.emplace_back(mistake.place.line, mistake.place.column);
  EXPECT_THAT(places,
              ElementsAre(std::pair(1, 1), std::pair(2, 8), std::pair(5, 9), std::pair(6, 8),
                          std::pair(7, 6), std::pair(9, 8), std::pair(10, 9), std::pair(12, 13)))
      << InvalidFile(mistakes).what();
}

TEST(ProcedureFile, AnUnreadableFileIsNotAnInvalidFile) {
  try {
    load_procedure("no/such/file.toml");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.exit_code(), ExitCode::failed);
    EXPECT_THAT(error.what(), HasSubstr("no/such/file.toml"));
  }
}

}  // namespace
}  // namespace heft
