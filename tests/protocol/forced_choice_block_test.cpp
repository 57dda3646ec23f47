// answers = "heavier" of comparison blocks: the shipped example, and each mistake at its place.
#include <gmock/gmock.h>

#include "EditedFile.h"
#include "protocol/Protocol.h"
#include "tasks/Comparison.h"

namespace heft {
namespace {

std::string example() {
  return content_of(shipped_path("examples/forced_choice"));
}

TEST(ForcedChoiceBlock, OfTheExampleHasItsKeys) {
  const Protocol protocol = load_protocol(shipped_path("examples/forced_choice"));
  const auto& block = *block_as<Comparison::Block>(protocol.blocks.at(1));
  EXPECT_EQ(block.answers, ComparisonAnswers::heavier);
  EXPECT_EQ(block.wording(), "heavier");
  ASSERT_EQ(block.staircases.size(), 2u);
  EXPECT_EQ(block.staircases[0].staircase.planned_levels().front(), -160);
  EXPECT_GE(block.expected_trials(), 24 + 12) << "constant, and a staircase with six reversals";
  EXPECT_LE(block.expected_trials(), 24 + 40);
}

TEST(ForcedChoiceBlock, AllowsUpDownLevelsBelowZero) {
  std::string text = example();
  text.replace(text.find("floor = 5"), 9, "floor = -150");
  EXPECT_NO_THROW(parse_protocol(text, "x.toml"));
}

TEST(ForcedChoiceBlock, WithThreeAnswersLevelsBelowZeroAreRefused) {
  std::string text = example();
  text.replace(text.find("floor = 5"), 9, "floor = -150");
  text.replace(text.find("answers = \"heavier\" "), 20, "");
  EXPECT_THROW(parse_protocol(text, "x.toml"), InvalidFile);
}

std::string same_different() {
  return content_of(shipped_path("examples/same_different"));
}

TEST(SameDifferentBlock, OfTheExampleHasItsKeys) {
  const Protocol protocol = parse_protocol(same_different(), "x.toml");
  const auto& block = *block_as<Comparison::Block>(protocol.blocks.at(1));
  EXPECT_EQ(block.answers, ComparisonAnswers::same_different);
  EXPECT_EQ(block.wording(), "same_different");
  EXPECT_EQ(block.expected_trials(), 32 + 4);
}

class BrokenSameDifferent : public testing::TestWithParam<Broken> {};

TEST_P(BrokenSameDifferent, IsOneMistakeAtItsPlace) {
  expect_broken(same_different(), GetParam(), [](auto& text) { parse_protocol(text, "x.toml"); });
}

const std::string constant_keys =
    "kind = \"constant\"\nlevels = [-160, -80, -40, -20, 20, 40, 80, 160]\nn_per_level = 4\n";
const std::vector<Broken> broken_same_different{
    {"positive_answer",
     {"answers = \"same_different\"",
      "positive_answer = ^\"correct_choice\"\nanswers = \"same_different\""},
     {"positive_answer together with answers = \"same_different\""}},
    {"indecision",
     {constant_keys,
      "kind = \"psi\"\nfunction = ^\"indecision\"\nlevels = [50, 100]\nsensitivity = [0.01, 0.02]\n"
      "indecision = [0, 1]\nbias = 0\nlapse = 0.02\nstop_trials = 10\n"},
     {"indecision", "which cube is heavier"}},
    {"lighter_comparison_of_a_staircase",
     {constant_keys,
      "kind = \"up_down\"\nstart = 100\nstep = 50\nfloor = ^-50\nstop_reversals = 4\n"
      "stop_trials = 20\ndiscard_reversals = 1\n"},
     {"floor is -50"}},
};

INSTANTIATE_TEST_SUITE_P(Each, BrokenSameDifferent, testing::ValuesIn(broken_same_different),
                         name_of_broken);

class BrokenForcedChoice : public testing::TestWithParam<Broken> {};

TEST_P(BrokenForcedChoice, IsOneMistakeAtItsPlace) {
  expect_broken(example(), GetParam(), [](auto& text) { parse_protocol(text, "x.toml"); });
}

const std::vector<Broken> broken_forced_choices{
    {"unknown_answers", {"answers = \"heavier\"", "answers = ^\"heavyer\""}, {"heavier"}},
    {"positive_answer",
     {"answers = \"heavier\"", "positive_answer = ^\"correct_choice\"\nanswers = \"heavier\""},
     {"positive_answer together with answers"}},
    {"floor_without_mass", {"floor = 5", "floor = ^-200"}, {"weigh 0 g or less"}},
    {"level_without_mass", {"levels = [-160", "levels = [^-200"}, {"0 g or less"}},
};

INSTANTIATE_TEST_SUITE_P(Each, BrokenForcedChoice, testing::ValuesIn(broken_forced_choices),
                         name_of_broken);

}  // namespace
}  // namespace heft
