// Questionnaire files: the shipped ones, each mistake at its place, and their use by protocols.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "EditedFile.h"
#include "SourceFolder.h"
#include "experiment/ScreenTexts.h"
#include "protocol/Protocol.h"
#include "protocol/readers/Files.h"

namespace heft {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string file_of(const std::string& name, const std::string& language = "en") {
  return source_folder() + "/protocols/questionnaires/" + name + '.' + language + ".toml";
}

const std::string every_kind = R"([questionnaire.q]
title = "T"
[[questionnaire.q.question]]
key = "a"
kind = "choice"
text = "A?"
choice = [{ value = "x", text = "X" }, { value = "y", text = "Y" }]
[[questionnaire.q.question]]
key = "b"
kind = "likert"
text = "B?"
low = "no"
high = "yes"
from = 1
to = 5
[[questionnaire.q.question]]
key = "c"
kind = "slider"
text = "C?"
low = "few"
high = "many"
[[questionnaire.q.question]]
key = "d"
kind = "number"
text = "D?"
least = 0
most = 120
[[questionnaire.q.question]]
key = "e"
kind = "text"
text = "E?"
)";

TEST(QuestionnaireFile, ShippedFilesAreValidAndNameTheirSource) {
  for (const std::string name :
       {"nasa_tlx", "borg_cr10", "presence", "ownership", "dissimilarity"}) {
    const std::string text = content_of(file_of(name));
    EXPECT_EQ(recognized_kind(text, "f"), FileKind::questionnaires);
    const ScreenTexts read = parse_questionnaires(text, name);
    const Questionnaire& questionnaire = read.questionnaires.at(name);
    EXPECT_THAT(questionnaire.source, ::testing::ContainsRegex("\\((19|20)[0-9][0-9]\\)"));
    EXPECT_TRUE(read.pages.contains(questionnaire_page(name)));
  }
  const auto tlx = parse_questionnaires(content_of(file_of("nasa_tlx")), "f");
  EXPECT_EQ(tlx.questionnaires.at("nasa_tlx").questions.size(), 6U);
}

// The logged part of a question, which does not depend on its language.
std::string logged_of(const FormQuestion& question) {
  std::string all = question.key + ' ' + std::string(name_of(question.kind));
  for (const AnswerChoice& choice : question.choices) all += ' ' + choice.value;
  return all +
         fmt::format(" {} {} {} {}", question.from, question.to, question.least, question.most);
}

TEST(QuestionnaireFile, ShippedFilesAreEqualInFrenchAndMarkedAsNotValidated) {
  for (const std::string name :
       {"nasa_tlx", "borg_cr10", "presence", "ownership", "dissimilarity"}) {
    const std::string text = content_of(file_of(name, "fr"));
    const ScreenTexts english = parse_questionnaires(content_of(file_of(name)), name),
                      french = parse_questionnaires(text, name);
    EXPECT_THAT(french.questionnaires.at(name).source, HasSubstr("non validée")) << name;
    std::vector<std::string> asked, in_french;
    for (const FormQuestion& question : english.questionnaires.at(name).questions)
      asked.push_back(logged_of(question));
    for (const FormQuestion& question : french.questionnaires.at(name).questions)
      in_french.push_back(logged_of(question));
    EXPECT_EQ(asked, in_french);
  }
}

TEST(QuestionnaireFile, MayBeAppendedToATextFile) {
  const std::string texts = content_of(source_folder() + "/protocols/texts/en.toml");
  const ScreenTexts both = parse_texts(texts + '\n' + every_kind, "f");
  EXPECT_EQ(both.language, "en");
  const Questionnaire& q = both.questionnaires.at("q");
  ASSERT_EQ(q.questions.size(), 5U);
  EXPECT_EQ(q.questions[0].choices[1].value, "y");
  EXPECT_EQ(q.questions[1].to, 5);
  EXPECT_EQ(q.questions[3].most, 120);
  EXPECT_THAT(page_text(both, "questionnaire_q"),
              ::testing::AllOf(HasSubstr("a_x: X"), HasSubstr("c_high: many")))
      << "all texts are hashed";
}

TEST(QuestionnaireFile, NumbersOutsideTheirRangeAreRefused) {
  const auto read = parse_questionnaires(every_kind, "f");
  const FormQuestion& number = read.questionnaires.at("q").questions[3];
  for (const char* good : {"0", "12.5", "120"}) EXPECT_TRUE(takes_answer(number, good)) << good;
  for (const char* bad : {"", ".", "121", "12.5.", "x"})
    EXPECT_FALSE(takes_answer(number, bad)) << bad;
}

class BrokenQuestionnaire : public ::testing::TestWithParam<Broken> {};

TEST_P(BrokenQuestionnaire, IsOneMistakeAtItsPlace) {
  expect_broken(every_kind, GetParam(), [](auto& text) { parse_questionnaires(text, "x.toml"); });
}

const std::vector<Broken> broken_questionnaires{
    {"kind", {"\"slider\"", "^\"slidder\""}, {"kind", "\"slider\"?"}},
    {"unknown_key", {"least = 0", "least = 0\n^step = 2"}, {"unknown key \"step\""}},
    {"kept_key_too", {"\"b\"", "^\"answered_by\""}, {"is reserved for the log"}},
    {"kept_key", {"\"a\"", "^\"done_s\""}, {"is reserved for the log"}},
    {"key_with_a_blank", {"\"a\"", "^\"a b\""}, {"lowercase letters"}},
    {"two_of_a_key", {"\"b\"", "^\"a\""}, {"two questions are \"a\""}},
    {"one_choice", {"choice = [{ value = \"x\", text = \"X\" }, ", "choice = ^["}, {"choice of 1"}},
    {"two_of_a_value", {"value = \"y\"", "value = ^\"x\""}, {"two choices are \"x\""}},
    {"empty_word", {"\"few\"", "^\"\""}, {"low", "empty"}},
    {"turned_range", {"most = 120", "most = ^-1"}, {"expected more than least 0"}},
    {"two_points", {"to = 5", "to = ^2"}, {"three points"}},
};

INSTANTIATE_TEST_SUITE_P(Each, BrokenQuestionnaire, ::testing::ValuesIn(broken_questionnaires),
                         name_of_broken);

std::string protocol_asking(const std::string& questionnaires) {
  return "title = \"t\"\n[layout]\nout_of_area = \"together\"\n[screens]\ntext_size = 1.25\n" +
         questionnaires +
         "[[block]]\nkind = \"sorting\"\nname = \"s\"\n"
         "masses_g = [15, 200, 800]\ntrials = { C1 = 1 }\n";
}

TEST(AskedQuestionnaires, ComeAfterABlockOrAtTheEnd) {
  const Protocol protocol = parse_protocol(
      protocol_asking("[[screens.questionnaire]]\nname = \"borg_cr10\"\nafter = \"s\"\n"
                      "[[screens.questionnaire]]\nname = \"nasa_tlx\"\n"
                      "[[screens.questionnaire]]\nname = \"presence\"\n"),
      "p.toml");
  EXPECT_THAT(protocol.screens.questionnaires.at("s"), ElementsAre("borg_cr10"));
  EXPECT_THAT(protocol.screens.questionnaires.at(""), ElementsAre("nasa_tlx", "presence"));
  EXPECT_EQ(protocol.screens.text_size, 1.25);
}

TEST(AskedQuestionnaires, RepeatedAndInvalidNamesAreRefused) {
  const auto mistake_in = [](const std::string& names) -> std::string {
    const auto mistakes = mistakes_of([&] { parse_protocol(protocol_asking(names), "p.toml"); });
    return mistakes.size() == 1 ? mistakes[0].message : "";
  };
  const std::string table = "[[screens.questionnaire]]\n";
  EXPECT_THAT(mistake_in(table + "name = \"q\"\n" + table + "name = \"q\"\n"),
              HasSubstr("\"q\" is already asked at the end"));
  EXPECT_EQ(mistake_in(table + "name = \"q\"\n" + table + "name = \"q\"\nafter = \"s\"\n"), "");
  for (const char* name : {"../q", "a.b", "q r"})
    EXPECT_THAT(mistake_in(table + "name = \"" + name + "\"\n"),
                HasSubstr("expected letters, digits"))
        << name;
}

TEST(AskedQuestionnaires, AfterAnUnknownBlockAreRefused) {
  const auto mistakes = mistakes_of([] {
    parse_protocol(
        protocol_asking("[[screens.questionnaire]]\nname = \"q\"\nafter = \"sorting\"\n"),
        "p.toml");
  });
  ASSERT_EQ(mistakes.size(), 1U);
  EXPECT_THAT(mistakes[0].message, HasSubstr("after \"sorting\""));
  EXPECT_GT(mistakes[0].place.line, 0);
}

}  // namespace
}  // namespace heft
