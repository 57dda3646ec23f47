// Judgment blocks: the shipped example, and each mistake at its place.
#include <gmock/gmock.h>

#include <algorithm>

#include "EditedFile.h"
#include "protocol/Protocol.h"
#include "protocol/readers/Files.h"
#include "tasks/Judgment.h"

namespace heft {
namespace {

std::string example() {
  return content_of(shipped_path("examples/judgment"));
}
std::string question_file(const std::string& language) {
  return source_folder() + "/protocols/questionnaires/dissimilarity." + language + ".toml";
}

TEST(JudgmentBlock, OfTheExampleHasItsKeysAndItsQuestionInBothLanguages) {
  const Protocol protocol = load_protocol(shipped_path("examples/judgment"));
  Judgment::Block block = *block_as<Judgment::Block>(protocol.blocks.at(0));
  EXPECT_THAT(block.masses_g, testing::ElementsAre(50, 100, 200, 400));
  EXPECT_EQ(block.cubes, 2);
  ASSERT_EQ(block.trials.size(), 1u);
  EXPECT_EQ(block.trials[0].technique, "C2");
  EXPECT_EQ(block.expected_trials(), 6 * 2);
  EXPECT_THAT(questionnaires_of(protocol), testing::ElementsAre("dissimilarity"));
  for (const char* language : {"en", "fr"}) {
    const std::string file = question_file(language);
    block.read_question(parse_questionnaires(content_of(file), file).questionnaires);
    ASSERT_TRUE(block.question) << language;
    EXPECT_EQ(block.question->kind, QuestionKind::likert);
    block.question.reset();
  }
}

// A lab can define its own task without programming.
TEST(JudgmentBlock, OfTheExampleIsShort) {
  const std::string both = example() + content_of(question_file("en"));
  EXPECT_LT(std::ranges::count(both, '\n'), 40);
}

TEST(JudgmentBlock, MayHaveTrialsByTechniqueAndAllCubesInEachTrial) {
  const std::string keys = "trials = 2           # of each set, in `condition`; or trials";
  std::string text = example();
  text.replace(text.find(keys), keys.size(), "trials");
  text.erase(text.find("condition = \"C2\"\n"), 17);
  text.erase(text.find("cubes = 2"), 9);
  const Protocol protocol = parse_protocol(text, "x.toml");
  const auto& block = *block_as<Judgment::Block>(protocol.blocks.at(0));
  EXPECT_EQ(block.expected_trials(), 4);
  EXPECT_EQ(block.most_cubes(), 4);
}

class BrokenJudgment : public testing::TestWithParam<Broken> {};

TEST_P(BrokenJudgment, IsOneMistakeAtItsPlace) {
  expect_broken(example(), GetParam(), [](auto& text) { parse_protocol(text, "x.toml"); });
}

Edit without_question() {
  const std::string text = example(), block = text.substr(text.find("[[block]]"));
  return {block, '^' + block.substr(0, block.find("question ="))};
}

const std::vector<Broken> broken_judgments{
    {"no_masses",
     {"[[block]]\nkind = \"judgment\"\nname = \"pairs\"\nmasses_g = [50, 100, 200, 400]",
      "^[[block]]\nkind = \"judgment\"\nname = \"pairs\""},
     {"lacks \"masses_g\""}},
    {"no_question", without_question(), {"lacks \"question\""}},
    {"question_without_key",
     {"\"dissimilarity.heaviness\"", "^\"dissimilarity\""},
     {"question is \"dissimilarity\"", "NAME.KEY"}},
    {"too_many_cubes", {"cubes = 2 ", "cubes = ^5 "}, {"cubes is 5 of 4 masses", "at most 4"}},
    {"more_cubes_than_places", {"cubes = 2 ", "cubes = ^7 "}, {"cubes is 7"}},
    {"no_trials", {"trials = 2 ", "trials = ^0 "}, {"trials is 0"}},
    {"too_many_trials", {"trials = 2 ", "trials = ^100 "}, {"the block has 600 trials"}},
    {"no_weight", {"[50, 100", "[^0, 100"}, {"masses_g"}},
    {"unknown_technique", {"\"C2\"\n# NAME", "^\"C3\"\n# NAME"}, {"C3"}},
    {"unknown_key", {"cubes = 2 ", "^cube = 2 "}, {"\"cube\""}},
};

INSTANTIATE_TEST_SUITE_P(Each, BrokenJudgment, testing::ValuesIn(broken_judgments), name_of_broken);

}  // namespace
}  // namespace heft
