// practice = { ... } of blocks of trials: its keys, and each mistake at its place.
#include <gmock/gmock.h>

#include "EditedFile.h"
#include "protocol/Protocol.h"
#include "protocol/readers/Files.h"

namespace heft {
namespace {

// The judgments of the example, and the comparisons of quick.toml, with practice.
std::string judgments() {
  return edited(content_of(shipped_path("examples/judgment")),
                {"trials = 2 ", "practice = { trials = 3 }\ntrials = 2 "})
      .text;
}
std::string comparisons() {
  return edited(content_of(shipped_path("quick")),
                {"kind = \"comparison\"\n",
                 "kind = \"comparison\"\n"
                 "practice = { trials = 4, until_correct = 2, feedback = true }\n"})
      .text;
}

const TaskBlock& practiced(const Protocol& protocol) {
  for (const Block& block : protocol.blocks)
    if (const auto* trials = std::get_if<TaskBlock>(&block); trials && trials->practice)
      return *trials;
  throw std::logic_error("no block has practice");
}

TEST(PracticeKeys, AreReadForAnyTask) {
  const Protocol plain = parse_protocol(judgments(), "x.toml");
  EXPECT_EQ(practiced(plain).practice->trials, 3);
  EXPECT_FALSE(practiced(plain).practice->until_correct);
  EXPECT_FALSE(practiced(plain).practice->feedback);
  EXPECT_EQ(practiced(plain).expected_trials(), 12 + 3);
  const Protocol protocol = parse_protocol(comparisons(), "x.toml");
  const TaskBlock& block = practiced(protocol);
  EXPECT_EQ(block.practice->until_correct, 2);
  EXPECT_TRUE(block.practice->feedback);
  EXPECT_THAT(block.choices(),
              testing::Contains(std::pair<std::string, std::string>(
                  "practice in " + block.name(),
                  "at most 4 trials, until 2 in a row are correct, with feedback")));
}

TEST(PracticeKeys, WithFeedbackNeedItsTextsInTheLanguage) {
  const std::string file = source_folder() + "/protocols/texts/en.toml";
  const std::string without = edited(content_of(file), {"not_correct = ", "# "}).text;
  const ScreenTexts texts = parse_texts(without, "own.toml");
  require_words(texts, parse_protocol(judgments(), "x.toml"), "own.toml");
  try {
    require_words(texts, parse_protocol(comparisons(), "x.toml"), "own.toml");
    ADD_FAILURE() << "no text is missing";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("own.toml lacks"));
    EXPECT_THAT(error.what(), testing::HasSubstr("[trial] not_correct"));
  }
}

class BrokenPractice : public testing::TestWithParam<std::pair<bool, Broken>> {};

TEST_P(BrokenPractice, IsOneMistakeAtItsPlace) {
  const auto& [of_comparisons, broken] = GetParam();
  expect_broken(of_comparisons ? comparisons() : judgments(), broken,
                [](auto& text) { parse_protocol(text, "x.toml"); });
}

const std::vector<std::pair<bool, Broken>> broken_practices{
    {false,
     {"feedback_without_correct_answers",
      {"practice = { trials = 3 }", "practice = ^{ trials = 3, feedback = true }"},
      {"answers of the task judgment are neither correct"}}},
    {false,
     {"criterion_without_correct_answers",
      {"practice = { trials = 3 }", "practice = ^{ trials = 3, until_correct = 2 }"},
      {"answers of the task judgment are neither correct"}}},
    {false, {"no_trials", {"{ trials = 3 }", "{ trials = ^0 }"}, {"trials is 0"}}},
    {false, {"without_trials", {"{ trials = 3 }", "^{ }"}, {"lacks \"trials\""}}},
    {false, {"a_number", {"{ trials = 3 }", "^3"}, {"practice"}}},
    {true,
     {"more_correct_than_trials",
      {"practice = { trials = 4", "practice = ^{ trials = 1"},
      {"until_correct is 2, expected at most trials 1"}}},
    {true, {"unknown_key", {"feedback = true }", "^sound = true }"}, {"\"sound\""}}},
};

INSTANTIATE_TEST_SUITE_P(Each, BrokenPractice, testing::ValuesIn(broken_practices),
                         [](const auto& one) { return std::string(one.param.second.name); });

}  // namespace
}  // namespace heft
