// Judgment blocks with procedures: the shipped example, and each mistake at its place.
#include <gmock/gmock.h>

#include "EditedFile.h"
#include "protocol/Protocol.h"
#include "protocol/readers/Files.h"
#include "tasks/Judgment.h"

namespace heft {
namespace {

std::string example() {
  return content_of(shipped_path("examples/judgment_staircase"));
}

TEST(JudgmentStaircaseBlock, OfTheExampleHasItsKeysAndSuitsItsQuestionInBothLanguages) {
  const Protocol protocol = load_protocol(shipped_path("examples/judgment_staircase"));
  const auto& single = *block_as<Judgment::Block>(protocol.blocks.at(0));
  const auto& pair = *block_as<Judgment::Block>(protocol.blocks.at(1));
  EXPECT_EQ(single.responses, (Meanings{{"no", Meaning::negative}, {"yes", Meaning::positive}}));
  ASSERT_EQ(single.staircases.size(), 1u);
  EXPECT_EQ(single.staircases[0].reference_g, 0);
  EXPECT_EQ(pair.staircases.at(0).reference_g, 200);
  EXPECT_TRUE(pair.staircases.at(0).staircase.is_bayesian());
  EXPECT_EQ(pair.expected_trials(), 20);
  EXPECT_FALSE(pair.is_forced());
  for (const char* language : {"en", "fr"}) {
    const std::string file =
        source_folder() + "/protocols/questionnaires/heavy." + language + ".toml";
    const auto forms = parse_questionnaires(content_of(file), file).questionnaires;
    for (Judgment::Block block : {single, pair}) {
      block.read_question(forms);
      ASSERT_TRUE(block.question) << language;
      EXPECT_EQ(block.mistake_in_question(), std::nullopt);
    }
  }
}

class BrokenJudgmentStaircase : public testing::TestWithParam<Broken> {};

TEST_P(BrokenJudgmentStaircase, IsOneMistakeAtItsPlace) {
  expect_broken(example(), GetParam(), [](auto& text) { parse_protocol(text, "x.toml"); });
}

const std::string yes_no = "responses = { yes = \"positive\", no = \"negative\" }";
const std::vector<Broken> broken_staircases{
    {"no_responses",
     {"[[block]]\nkind = \"judgment\"\nname = \"harder\"\nquestion = "
      "\"heavy.harder\"\n# With a reference there are two cubes, and a choice may "
      "be one of them; \"none\": neither.\nresponses = { left = \"left\", right = "
      "\"right\", same = \"none\" }",
      "^[[block]]\nkind = \"judgment\"\nname = \"harder\"\nquestion = "
      "\"heavy.harder\""},
     {"lacks \"responses\"", "\"left\""}},
    {"unknown_response", {"yes = \"positive\"", "yes = ^\"positiv\""}, {"positiv", "positive"}},
    {"one_sided",
     {yes_no, "responses = ^{ yes = \"positive\", no = \"positive\" }"},
     {"responses has no = positive, yes = positive", "{ yes = \"positive\", no = \"negative\" }"}},
    {"left_without_right",
     {yes_no, "responses = ^{ yes = \"left\", no = \"none\" }"},
     {"responses has", "{ first = \"left\", second = \"right\" }"}},
    {"sides_of_one_cube",
     {yes_no, "responses = ^{ yes = \"left\", no = \"right\" }"},
     {"there is one cube", "reference_g"}},
    {"masses_too",
     {"condition = \"C2\"\n\n[[block.staircase]]         # without",
      "condition = \"C2\"\nmasses_g = ^[100]\n\n[[block.staircase]] # without"},
     {"masses_g together with [[block.staircase]]"}},
    {"weightless", {"floor = 10 ", "floor = ^0 "}, {"floor has 0", "mass of the cube"}},
    {"lighter_than_nothing",
     {"levels = { from = -160, to = 160", "levels = ^{ from = -200, to = 160"},
     {"levels has -200", "weigh 0 g"}},
    {"no_procedure", {"kind = \"quest_plus\"", "kind = ^\"quest_minus\""}, {"quest_minus"}},
};

INSTANTIATE_TEST_SUITE_P(Each, BrokenJudgmentStaircase, testing::ValuesIn(broken_staircases),
                         name_of_broken);

// The indecision model is of cubes, not of yes and no.
TEST(JudgmentStaircaseBlock, RefusesTheIndecisionModelForYesAndNo) {
  const Broken broken{"indecision",
                      {"responses = { left = \"left\", right = \"right\", same = \"none\" }",
                       "responses = { left = \"positive\", right = \"positive\", same = "
                       "\"negative\" }"},
                      {}};
  const auto file = edited(example(), broken.edit);
  const auto mistakes = mistakes_of([&] { parse_protocol(file.text, "x.toml"); });
  ASSERT_EQ(mistakes.size(), 1u);
  EXPECT_THAT(mistakes[0].message, testing::HasSubstr("which cube is heavier"));
}

}  // namespace
}  // namespace heft
