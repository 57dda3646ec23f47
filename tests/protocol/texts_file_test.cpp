// Text files: the shipped ones, each mistake at its place, and the hashed text.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "EditedFile.h"
#include "SourceFolder.h"
#include "base/Error.h"
#include "experiment/ScreenTexts.h"
#include "protocol/readers/Files.h"
#include "tasks/Tasks.h"
#include "tasks/blocks/SessionPlan.h"

namespace heft {
namespace {

std::string texts_path(const std::string& language) {
  return source_folder() + "/protocols/texts/" + language + ".toml";
}

TEST(TextsFile, ShippedLanguagesAreComplete) {
  for (const std::string language : {"en", "fr"}) {
    const ScreenTexts texts = load_texts(texts_path(language));
    EXPECT_EQ(texts.language, language);
    EXPECT_FALSE(texts.at("trial_comparison", "no_difference").empty());
    EXPECT_EQ(recognized_kind(content_of(texts_path(language)), "f"), FileKind::texts);
  }
}

// Files written before --tracker mouse lack its text.
TEST(TextsFile, MayLackLaterTexts) {
  std::string text = content_of(texts_path("en"));
  const auto at = text.find("drag_effector");
  ASSERT_NE(at, std::string::npos);
  EXPECT_FALSE(parse_texts(text, "f").if_any("trial", "drag_effector").empty());
  text.erase(at, text.find('\n', at) - at);
  EXPECT_TRUE(parse_texts(text, "f").if_any("trial", "drag_effector").empty());
  EXPECT_TRUE(parse_texts(text, "f").if_any("no_page", "drag_effector").empty());
}

// The wording influences the criterion, so it must not reveal the subject of the study.
TEST(TextsFile, ShippedTextsNameNeitherLagNorIllusionNorMassesNorConditions) {
  for (const std::string language : {"en", "fr"})
    for (const auto& [page, keys] : load_texts(texts_path(language)).pages)
      for (const auto& [key, text] : keys)
        for (const std::string word :
             {" lag", "delay", "illusion", "decoupl", "gram", " mass", "C1", "C2", "incorrect",
              "wrong", "retard", "décal", "découpl", "faux", "fausse", "pseudo", "spring"})
          EXPECT_EQ(text.find(word), std::string::npos) << language << ' ' << page << '.' << key;
}

// A line must not begin with a mark, or end with an opening one.
TEST(TextsFile, FrenchMarksDoNotLeaveTheirWords) {
  ScreenTexts texts = load_texts(texts_path("fr"));
  for (const std::string name :
       {"borg_cr10", "dissimilarity", "heavy", "nasa_tlx", "ownership", "presence"}) {
    const std::string path = source_folder() + "/protocols/questionnaires/" + name + ".fr.toml";
    for (const auto& [key, form] : parse_questionnaires(content_of(path), path).questionnaires)
      for (const FormQuestion& question : form.questions)
        texts.pages[name][key + question.key] = question.text;
  }
  for (const auto& [page, keys] : texts.pages)
    for (const auto& [key, text] : keys)
      for (const char* apart : {" ?", " !", " :", " ;", " »", "« "})
        EXPECT_EQ(text.find(apart), std::string::npos) << page << ' ' << key << ": " << text;
}

TEST(TextsFile, EveryScreenHasItsPage) {
  const ScreenTexts texts = load_texts(texts_path("en"));
  const auto n_screens = static_cast<std::size_t>(Screen::questionnaire);  // pages of their own
  ASSERT_EQ(n_screens + 1, EnumNames<Screen>::names.size());
  for (std::size_t screen = 0; screen < n_screens; ++screen)
    for (const Task task : words_of<Task>())
      EXPECT_TRUE(texts.pages.contains(text_page(static_cast<Screen>(screen), task)));
}

// A text file that is older than a task can be used for protocols without that task.
TEST(TextsFile, MayLackATaskExceptForItsProtocols) {
  for (const std::string_view task : words_of<Task>()) {
    std::string text = content_of(texts_path("en"));
    const std::string page = text_page(Screen::trial, task);
    const auto begin = text.find('[' + page + ']');
    ASSERT_NE(begin, std::string::npos);
    text.erase(begin, text.find("\n[", begin) - begin);
    const ScreenTexts texts = parse_texts(text, "own.toml");
    for (const std::string_view other : words_of<Task>()) {
      SessionPlan plan;
      Tasks::call(other, [&]<typename Kind>() { plan.blocks = {typename Kind::Block{}}; });
      if (other != task) {
        EXPECT_NO_THROW(require_words(texts, plan, "own.toml")) << task << ' ' << other;
        continue;
      }
      try {
        require_words(texts, plan, "own.toml");
        ADD_FAILURE() << task;
      } catch (const Error& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("own.toml lacks"));
        const std::string_view keys = task_named(task).texts;
        EXPECT_THAT(error.what(), testing::HasSubstr(fmt::format("[{}] {}", page,
                                                                 keys.substr(0, keys.find(' ')))));
      }
    }
  }
}

// A text file that is older than a way to ask can be used for protocols that ask otherwise.
TEST(TextsFile, MayLackAWordingExceptForItsProtocols) {
  std::string text = content_of(texts_path("en"));
  const auto begin = text.find("question_same_different");
  text.erase(begin, text.find('\n', begin) - begin);
  const ScreenTexts texts = parse_texts(text, "own.toml");
  for (const ComparisonAnswers answers :
       {ComparisonAnswers::heavier_or_none, ComparisonAnswers::heavier,
        ComparisonAnswers::same_different}) {
    SessionPlan plan;
    Comparison::Block block;
    block.answers = answers;
    plan.blocks = {block};
    if (answers != ComparisonAnswers::same_different) {
      EXPECT_NO_THROW(require_words(texts, plan, "own.toml"));
      continue;
    }
    try {
      require_words(texts, plan, "own.toml");
      ADD_FAILURE();
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("[trial_comparison] question_same_different"));
    }
  }
}

class BrokenTexts : public testing::TestWithParam<Broken> {};

TEST_P(BrokenTexts, IsOneMistakeAtItsPlace) {
  expect_broken(content_of(texts_path("en")), GetParam(),
                [](auto& text) { parse_texts(text, "x.toml"); });
}

const std::vector<Broken> broken_texts{
    {"missing_key", {"[slots]\nleft = \"Left\"", "^[slots]"}, {"[slots] lacks \"left\""}},
    {"misspelled_key", {"agree =", "^agre ="}, {"\"agre\"", "\"agree\"?"}},
    {"unknown_key", {"[slots]\n", "[slots]\n^top = \"Top\"\n"}, {"unknown key \"top\""}},
    {"misspelled_page", {"[paused]", "[^pausd]"}, {"\"pausd\"", "\"paused\"?"}},
    {"empty_text", {"\"Left\"", "^\"\""}, {"left", "not empty"}},
    {"blank_lines", {"\"Left\"", "^\"\\n \\n\""}, {"left", "empty"}},
    {"number", {"\"Left\"", "^1"}, {"left is 1"}},
};

INSTANTIATE_TEST_SUITE_P(Each, BrokenTexts, testing::ValuesIn(broken_texts), name_of_broken);

TEST(TextsFile, ReportsAMissingLanguage) {
  const EditedFile file = edited(content_of(texts_path("en")), {"language = \"en\"", ""});
  const auto mistakes = mistakes_of([&] { parse_texts(file.text, "x.toml"); });
  ASSERT_EQ(mistakes.size(), 1u);
  EXPECT_THAT(mistakes[0].message, testing::HasSubstr("lacks \"language\""));
}

TEST(PageText, IsIndependentOfTheOrderOfKeys) {
  const std::string text = content_of(texts_path("en"));
  const EditedFile moved = edited(
      text, {"left = \"Left\"\nmiddle = \"Middle\"", "middle = \" Middle\"\n\nleft = \"Left\""});
  const std::string page = page_text(parse_texts(text, "a"), "slots");
  EXPECT_EQ(page, "language: en\n\nleft: Left\n\nmiddle: Middle\n\nright: Right\n");
  EXPECT_EQ(page_text(parse_texts(moved.text, "b"), "slots"), page);
  const EditedFile changed = edited(text, {"\"Middle\"", "\"Center\""});
  EXPECT_NE(page_text(parse_texts(changed.text, "c"), "slots"), page);
}

}  // namespace
}  // namespace heft
