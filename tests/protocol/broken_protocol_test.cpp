// Each mistake in protocols, one by one and many together.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "EditedFile.h"
#include "protocol/Protocol.h"

namespace heft {
namespace {

using testing::ElementsAre;

const std::string everything = R"(title = "Everything"
display_rate_hz = 15
void_after_s = 5
require_contact = false
[effector]
size_m = [0.09, 0.04, 0.04]
[coupling]
stiffness_n_per_m = 50
[physics]
friction = 0.8
friction_is = "per_body"
gravity_m_s2 = 9.81
simulator = "bullet"
rate_hz = 240
[layout]
cube_size_m = 0.035
gap_m = 0.045
row_y_m = 0
start_distance_m = 0.06
area_m = [0.40, 0.30]
out_of_area = "return"
clear_m = 0.02
[[block]]
kind = "demonstration"
name = "demo"
duration_s = 20
[[block]]
kind = "introduction"
name = "intro"
masses_g = [15, 800]
condition = "C2"
wrong_answer = "same_layout"
[[block]]
kind = "sorting"
name = "sorting"
masses_g = [15, 200, 800.0]
trials = 10
c1_trials = 5
max_run = 2
orders = "random"
[[block]]
kind = "break"
name = "rest"
least_duration_s = 60
[[block]]
kind = "comparison"
name = "jnd"
catch_fraction = 0.1
positive_answer = "any_choice"
interleave = "random"
max_lag = 0
[[block.staircase]]
name = "15g"
reference_g = 15
start = 175
step = 50
floor = 0
[[block.staircase]]
name = "200g"
reference_g = 200
start = 60
step = 2
step_scale = "db"
)";

TEST(BrokenProtocolTest, HasAValidBase) {
  EXPECT_NO_THROW(parse_protocol(everything, "x.toml"));
}

class BrokenProtocol : public testing::TestWithParam<Broken> {};

TEST_P(BrokenProtocol, IsOneMistakeAtItsPlace) {
  expect_broken(everything, GetParam(), [](auto& text) { parse_protocol(text, "x.toml"); });
}

const Broken settings[] = {
    {"no_title", {"title = \"Everything\"", "^"}, {"the file lacks \"title\""}},
    {"title_of_two_lines", {"\"Everything\"", "^\"a\\nb\""}, {"title is", "a text on one line"}},
    {"name_with_controls", {"\"jnd\"", "^\"j\\u001bnd\""}, {"name is", "without control char"}},
    {"unknown_key", {"void_after_s", "^void_afer_s"}, {"\"void_after_s\"?"}},
    {"unknown_table",
     {"[coupling]\n", "[^coupler]\n"},
     {"unknown key \"coupler\"", "\"coupling\"?"}},
    {"display_rate_zero",
     {"= 15\n", "= ^0\n"},
     {"display_rate_hz is 0", "at least 1 and at most 1000"}},
    {"void_at_once", {"void_after_s = 5", "void_after_s = ^0"}, {"void_after_s is 0", "above 0"}},
    {"contact_as_text", {"= false", "= ^\"no\""}, {"require_contact", "true or false"}},
    {"unknown_simulator", {"\"bullet\"", "^\"bulet\""}, {"did you mean \"bullet\""}},
    {"physics_rate", {"240", "^0.5"}, {"rate_hz is 0.5", "at least 1"}},
    {"input", {"rate_hz = 240", "input = ^\"hod\""}, {"\"path\", \"hold\"", "mean \"hold\""}},
    {"predicted_too_far",
     {"rate_hz = 240", "predict_s = ^0.21"},
     {"predict_s is 0.21", "at least 0 and at most 0.2"}},
    {"predicted_into_the_past", {"rate_hz = 240", "predict_s = ^-0.01"}, {"predict_s is -0.01"}},
    {"friction_is", {"\"per_body\"", "^\"body\""}, {"\"between_surfaces\" or \"per_body\""}},
    {"compliance", {"rate_hz = 240", "contact_compliance_m_per_n = ^0.1"}, {"at most 0.01"}},
    {"unstable",
     {"stiffness_n_per_m = 50", "stiffness_n_per_m = 5e5\ndamping_ratio = ^0.01"},
     {"damping_ratio of 0.1 or more", "at least 590 steps"}},
    {"overlapping_cubes", {"0.045", "^-0.001"}, {"gap_m is -0.001", "at least 0"}},
    {"cubes_too_wide", {"[0.40, 0.30]", "^[0.19, 0.30]"}, {"3 cubes is 0.195 m wide", "0.19 m"}},
    {"row_too_far", {"[0.40, 0.30]", "^[0.40, 0.03]"}, {"reach 0.0175 m", "0.015 m"}},
    {"never_clear", {"= 0.06", "= ^0.01"}, {"start_distance_m 0.01 is less than clear_m 0.02"}},
    {"out_of_area", {"\"return\"", "^\"give back\""}, {"\"return\", \"together\" or \"stay\""}},
    {"area_of_three", {"[0.40, 0.30]", "^[0.40, 0.30, 1]"}, {"area_m has 3 numbers, expected 2"}},
};

const Broken blocks[] = {
    {"no_block", {everything, "^title = \"t\"\n"}, {"lacks \"block\""}},
    {"block_as_table",
     {everything, "title = \"t\"\n^[block]\nkind = \"break\"\n"},
     {"block is a table", "[[block]]"}},
    {"no_kind",
     {"[[block]]\nkind = \"sorting\"\n", "^[[block]]\n"},
     {"lacks \"kind\"", "\"sorting\""}},
    {"unknown_kind",
     {"\"sorting\"", "^\"questionnaire\""},
     {"kind is \"questionnaire\"", "\"judgment\", \"adjustment\" or \"break\""}},
    {"misspelled_kind_key",
     {"kind = \"sorting\"", "^knd = \"sorting\""},
     {"unknown key \"knd\"", "\"kind\"?"}},
    {"misspelled_kind", {"\"sorting\"", "^\"sortin\""}, {"did you mean \"sorting\""}},
    {"kind_as_number", {"\"sorting\"", "^3"}, {"kind is 3"}},
    {"no_block_name",
     {"[[block]]\nkind = \"sorting\"\nname = \"sorting\"", "^[[block]]\nkind = \"sorting\""},
     {"[[block]] lacks \"name\""}},
    {"two_blocks_of_a_name",
     {"\"rest\"", "^\"intro\""},
     {"another block is named \"intro\" (line 27)"}},
    {"key_of_another_kind", {"duration_s = 20", "^trials = 20"}, {"unknown key \"trials\""}},
    {"demonstration_of_no_time", {"duration_s = 20", "duration_s = ^0"}, {"above 0"}},
    {"break_of_negative_time", {"= 60\n", "= ^-60\n"}, {"least_duration_s is -60", "at least 0"}},
    {"break_first",
     {"\"demonstration\"\nname = \"demo\"\nduration_s = 20", "^\"break\"\nname = \"first\""},
     {"first block"}},
    {"break_last",
     {everything.substr(everything.find("[[block]]\nkind = \"comparison\"")),
      "[[block]]\nkind = \"introduction\"\nname = \"more\"\nmasses_g = [1, 2]\n[[block]]\nkind = "
      "^\"break\"\nname = \"last\"\n"},
     {"last block"}},
    {"two_breaks",
     {"[[block]]\nkind = \"comparison\"",
      "[[block]]\nkind = ^\"break\"\nname = \"second\"\n[[block]]\nkind = \"comparison\""},
     {"break follows a break"}},
    {"mass_zero", {"[15, 800]", "[^0, 800]"}, {"masses_g is 0", "above 0"}},
    {"mass_negative", {"[15, 800]", "[15, ^-800]"}, {"masses_g is -800", "above 0"}},
    {"mass_not_finite", {"800.0", "^inf"}, {"masses_g is inf", "finite"}},
    {"three_masses_to_compare", {"[15, 800]", "^[15, 200, 800]"}, {"3 masses, expected 2"}},
    {"one_mass_to_sort", {"[15, 200, 800.0]", "^[15]"}, {"1 masses, expected 2 to 6"}},
    {"no_masses",
     {"[[block]]\nkind = \"introduction\"\nname = \"intro\"\nmasses_g = [15, 800]",
      "^[[block]]\nkind = \"introduction\"\nname = \"intro\""},
     {"lacks \"masses_g\""}},
    {"equal_masses", {"[15, 200, 800.0]", "[15, 200, ^15.0]"}, {"15 g twice", "no right answer"}},
    {"unknown_condition", {"\"C2\"", "^\"C4\""}, {"\"C1\" or \"C2\""}},
    {"unknown_wrong_answer",
     {"\"same_layout\"", "^\"same\""},
     {"\"same_layout\" or \"reshuffle\""}},
    {"unknown_orders",
     {"orders = \"random\"", "orders = ^\"latin\""},
     {"\"random\" or \"balanced\""}},
    {"no_trials", {"trials = 10", "trials = ^0"}, {"trials is 0", "from 1 to 500"}},
    {"trials_missing",
     {"[[block]]\nkind = \"sorting\"\nname = \"sorting\"\nmasses_g = [15, 200, 800.0]\ntrials = 10",
      "^[[block]]\nkind = \"sorting\"\nname = \"sorting\"\nmasses_g = [15, 200, 800.0]"},
     {"lacks \"trials\""}},
    {"more_c1_than_trials",
     {"c1_trials = 5", "c1_trials = ^11"},
     {"c1_trials is 11", "at most trials 10"}},
    {"negative_c1", {"c1_trials = 5", "c1_trials = ^-1"}, {"c1_trials is -1"}},
    {"impossible_run",
     {"c1_trials = 5\nmax_run = 2", "c1_trials = 2\nmax_run = ^2"},
     {"8 trials of one technique and 2 of others", "at least 3"}},
};

const Broken comparisons[] = {
    {"no_staircase",
     {everything.substr(everything.find("[[block]]\nkind = \"comparison\"")),
      "^[[block]]\nkind = \"comparison\"\nname = \"jnd\"\n"},
     {"[[block]] lacks \"staircase\""}},
    {"only_catch_trials", {"0.1\n", "^1.0\n"}, {"catch_fraction is 1.0", "below 1"}},
    {"negative_catch_trials", {"0.1\n", "^-0.1\n"}, {"catch_fraction is -0.1", "at least 0"}},
    {"unknown_positive_answer",
     {"\"any_choice\"", "^\"any\""},
     {"\"any_choice\" or \"correct_choice\""}},
    {"negative_lag", {"max_lag = 0", "max_lag = ^-1"}, {"max_lag is -1"}},
    {"unknown_staircase_key", {"floor = 0", "floor = 0\n^max_trials = 5"}, {"[[block.staircase]]"}},
    {"no_reference",
     {"[[block.staircase]]\nname = \"15g\"\nreference_g = 15",
      "^[[block.staircase]]\nname = \"15g\""},
     {"[[block.staircase]] lacks \"reference_g\""}},
    {"reference_zero", {"reference_g = 15", "reference_g = ^0"}, {"reference_g is 0", "above 0"}},
    {"step_zero", {"step = 50", "step = ^0"}, {"step is 0", "above 0"}},
    {"no_floor",
     {"[[block.staircase]]\nname = \"15g\"\nreference_g = 15\nstart = 175\nstep = 50\nfloor = 0",
      "^[[block.staircase]]\nname = \"15g\"\nreference_g = 15\nstart = 175\nstep = 50"},
     {"lacks \"floor\"", "lighter than the reference", "0 or more"}},
    {"floor_below_the_reference",
     {"floor = 0", "floor = ^-5"},
     {"floor is -5", "lighter than the reference"}},
    {"catches_twice",
     {"catch_fraction = 0.1", "catch_fraction = ^0.1\ncatch_trials = 4"},
     {"catch_fraction together with catch_trials"}},
    {"catches_that_do_not_divide",
     {"catch_fraction = 0.1", "catch_trials = ^5"},
     {"catch_trials is 5 for 2 references", "\"15g\" = 2"}},
    {"catches_of_no_reference",
     {"catch_fraction = 0.1", "catch_trials = { 15g = 3, ^20g = 3 }"},
     {"unknown key \"20g\""}},
    {"catches_not_spread",
     {"catch_fraction = 0.1", "catch_every = ^9"},
     {"catch_every requires catch_trials"}},
    {"catches_too_dense",
     {"catch_fraction = 0.1", "catch_trials = 4\ncatch_every = ^3"},
     {"catch_every is 3", "from 4 to 500"}},
    {"one_side_only", {"max_lag = 0", "sides = ^\"left\""}, {"\"random\" or \"balanced\""}},
    {"below_without_pair",
     {"start = 175", "start = 175\nstart_below = ^5"},
     {"start_below requires paired"}},
    {"pair_below_above",
     {"start = 175", "start = 175\npaired = true\nstart_below = ^200"},
     {"starts at 200, expected below the start 175"}},
    {"pair_without_a_lower_start",
     {"start = 60", "start = 60\npaired = ^true"},
     {"from below starts at 60", "set start_below"}},
    {"pair_of_constants",
     {"start = 60\nstep = 2\nstep_scale = \"db\"\n",
      "paired = ^true\nkind = \"constant\"\nlevels = [10, 20]\nn_per_level = 2\n"},
     {"paired requires up_down staircases"}},
    {"constant_level_at_no_mass",
     {"start = 60\nstep = 2\nstep_scale = \"db\"\n",
      "kind = \"constant\"\nlevels = [10, ^-200, -199.5]\nn_per_level = 2\n"},
     {"levels has -200", "weigh 0 g or less", "above -200"}},
    {"misspelled_kind_of_staircase",
     {"start = 60\nstep = 2\nstep_scale = \"db\"\n",
      "kind = ^\"contant\"\nlevels = [10, 20]\nn_per_level = 2\n"},
     {"did you mean \"constant\""}},
    {"two_staircases_of_a_name",
     {"\"200g\"", "^\"15g\""},
     {"another staircase is named \"15g\" (line 52)"}},
    {"staircase_name_of_another_block",
     {"step_scale = \"db\"\n",
      "step_scale = \"db\"\n[[block]]\nkind = \"comparison\"\nname = "
      "\"more\"\n[[block.staircase]]\nname = ^\"15g\"\nreference_g = 5\nstart = 9\nstep = 1\nfloor "
      "= 0\n"},
     {"another staircase"}},
    {"db_start_zero", {"start = 60", "start = ^0"}, {"start is 0", "above 0"}},
};

INSTANTIATE_TEST_SUITE_P(Settings, BrokenProtocol, testing::ValuesIn(settings), name_of_broken);
INSTANTIATE_TEST_SUITE_P(Blocks, BrokenProtocol, testing::ValuesIn(blocks), name_of_broken);
INSTANTIATE_TEST_SUITE_P(Comparisons, BrokenProtocol, testing::ValuesIn(comparisons),
                         name_of_broken);

TEST(BrokenProtocolTest, ManyMistakesAreAllReportedInOrder) {
  std::string text = everything;
  for (const Edit& edit : std::vector<Edit>{{"void_after_s = 5", "void_after_s = -5"},
                                            {"[coupling]", "[couplings]"},
                                            {"0.8", "nan"},
                                            {"\"bullet\"", "\"bullit\""},
                                            {"0.045", "0.2"},
                                            {"\"introduction\"", "\"introductoin\""},
                                            {"[15, 800]", "[800, 800]"},
                                            {"c1_trials = 5", "c1_trials = 12"},
                                            {"\"rest\"", "\"intro\""},
                                            {"0.1\n", "1\n"},
                                            {"step = 50", "step = 0"},
                                            {"floor = 0", "foor = 0"},
                                            {"reference_g = 200", "reference_g = -200"}})
    text = edited(text, edit).text;
  const auto mistakes = mistakes_of([&] { parse_protocol(text, "x.toml"); });
  std::vector<int> lines;
  for (const Mistake& mistake : mistakes) lines.push_back(mistake.place.line);
  EXPECT_THAT(lines, ElementsAre(3, 7, 10, 13, 20, 28, 30, 38, 43, 48, 56, 57, 60))
      << InvalidFile(mistakes).what();
}

}  // namespace
}  // namespace heft
