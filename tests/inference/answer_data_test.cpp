// Files of answers: every form that can be read, and mistakes with their places.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "base/Error.h"
#include "inference/AnswerData.h"

namespace heft {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Key;
using testing::Pair;

const AnswerFormat psychometric{};
const AnswerFormat indecision_file{FitModel::indecision, std::nullopt, false};

AnswersByLevel only_group(const std::string& text, const AnswerFormat& format) {
  const auto groups = parse_answers(text, "data.csv", format);
  EXPECT_EQ(groups.size(), 1u);
  EXPECT_EQ(groups.at(0).name, std::nullopt);
  return groups.at(0).answers;
}

TEST(AnswerData, SaysWhoAnsweredInEachGroup) {
  const auto people = [](const std::string& header) {
    return parse_answers("x,response,room," + header + "\n1,0,a,P1\n1,1,a,P2\n2,1,b,P1\n",
                         "data.csv", {FitModel::psychometric, "room", false});
  };
  for (const char* column : {"person", "participant"}) {
    EXPECT_THAT(people(column).at(0).people, ElementsAre(Key("P1"), Key("P2")));
    EXPECT_THAT(people(column).at(1).people, ElementsAre(Key("P1")));
  }
  EXPECT_TRUE(people("who").at(0).people.empty());
}

TEST(AnswerData, CountsAndSingleTrialsComeToTheSame) {
  const AnswersByLevel expected{{1, {2, 1, 0}}, {2.5, {0, 2, 0}}};
  EXPECT_EQ(only_group("x,n_positive,n\n1,1,3\n2.5,2,2\n", psychometric), expected);
  EXPECT_EQ(only_group("n,x,n_positive\n2,1,0\n1,1,1\n2,2.5,2\n7,9,0\n0,5,0\n", psychometric).at(1),
            expected.at(1));
  EXPECT_EQ(only_group("x,response\n1,0\n1,1\n2.5,1\n1,0\n2.5,1\n", psychometric), expected);
}

TEST(AnswerData, ALevelThatWasNotShownIsNone) {
  EXPECT_EQ(only_group("x,n_positive,n\n1,0,0\n2,1,1\n", psychometric).size(), 1u);
}

TEST(AnswerData, Choices) {
  EXPECT_EQ(only_group("level_g,answer\n-5,comparison\n-5,none\n-5,reference\n-5,none\n",
                       indecision_file),
            (AnswersByLevel{{-5, {1, 2, 1}}}));
}

TEST(AnswerData, GroupsAreTextInTheOrderOfTheirFirstRows) {
  const auto groups = parse_answers(
      "\xEF\xBB\xBFx,\"who\",response,note\r\n1,01,1,\r\n1,\"1\",0,\"a,b\"\r\n2,01,0,\r\n",
      "data.csv", {FitModel::psychometric, "who", false});
  ASSERT_EQ(groups.size(), 2u);
  EXPECT_EQ(groups[0].name, "01");
  EXPECT_EQ(groups[1].name, "1");
  EXPECT_THAT(groups[0].answers,
              ElementsAre(Pair(1, ElementsAre(0, 1, 0)), Pair(2, ElementsAre(1, 0, 0))));
}

TEST(AnswerData, LevelsOfALogarithmMayBe0) {
  EXPECT_EQ(parse_answers("x,response\n0,1\n", "data.csv", {FitModel::psychometric, {}, true})
                .at(0)
                .answers.count(0),
            1u);
}

std::string refusal_of(const std::string& text, const AnswerFormat& format) {
  try {
    parse_answers(text, "data.csv", format);
  } catch (const InvalidFile& error) {
    return error.what();
  }
  return "none";
}

struct Refused {
  std::string text, message;
  AnswerFormat format = psychometric;
};

TEST(AnswerData, WrongRowsAreRefusedInTheirPlace) {
  const std::string counts = "x,n_positive,n\n";
  const std::vector<Refused> refused{
      {"", "data.csv:1:1: the file is empty"},
      {"x,y\n1,2\n", "data.csv:1:1: expected a header"},
      {"x,n_positive,n,response\n", "not with both"},
      {"x,n_positive,n,x\n1,1,1,1\n", "data.csv:1:16: a second column \"x\""},
      {counts, "data.csv:1:1: there are no rows"},
      {counts + "1,2\n", "data.csv:2:1: 2 cells, expected 3"},
      {counts + "1,2,3,4\n", "data.csv:2:1: 4 cells, expected 3"},
      {counts + "1,1,2\n\n2,3,2\n", "data.csv:4:3: n_positive is 3, more than n, 2"},
      {counts + "nan,1,2\n", "data.csv:2:1: x is \"nan\", expected a finite number"},
      {counts + "inf,1,2\n", "data.csv:2:1: x is \"inf\""},
      {counts + "1e999,1,2\n", "data.csv:2:1: x is \"1e999\""},
      {counts + "1, 1.5,2\n", "data.csv:2:4: \"1.5\", expected a whole number"},
      {counts + "1,-1,2\n", "data.csv:2:3: \"-1\""},
      {counts + "1,,2\n", "data.csv:2:3: \"\""},
      {counts + "1,1,1e10\n", "data.csv:2:5: \"1e10\""},
      {"x,response\n1,2\n", "data.csv:2:3: response is \"2\", expected 0 or 1"},
      {"x,response\n1,yes\n", "data.csv:2:3: response is \"yes\""},
      {"level_g,answer\n1,Comparison\n", "data.csv:2:3: answer is \"Comparison\"", indecision_file},
      {"x,response\n1,1\n", "data.csv:1:1: expected a header with level_g and answer",
       indecision_file},
      {counts + "-1,1,2\n", "expected 0 or more", {FitModel::psychometric, {}, true}},
  };
  for (const Refused& each : refused)
    EXPECT_THAT(refusal_of(each.text, each.format), HasSubstr(each.message)) << each.text;
}

TEST(AnswerData, EveryMistakeIsReportedUpToFifty) {
  std::string text = "x,response\n";
  for (int i = 0; i < 3; ++i) text += "a,b\n";
  const std::string three = refusal_of(text, psychometric);
  EXPECT_EQ(std::ranges::count(three, '\n'), 5);
  for (int i = 0; i < 1000; ++i) text += "a,b\n";
  const std::string many = refusal_of(text, psychometric);
  EXPECT_EQ(std::ranges::count(many, '\n'), 49);
}

TEST(AnswerData, AColumnThatIsNotThereIsAMistakeOfTheCommand) {
  try {
    parse_answers("x,response,who\n1,1,a\n", "data.csv", {FitModel::psychometric, "whom", false});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.exit_code(), ExitCode::usage);
    EXPECT_THAT(error.what(), HasSubstr("did you mean \"who\""));
  }
}

RC_GTEST_PROP(AnswerData, WhatIsWrittenIsRead, ()) {
  AnswersByLevel written;
  std::string text = "x,n_positive,n\n";
  for (const int x : *rc::gen::nonEmpty<std::vector<int>>()) {
    const int n = *rc::gen::inRange(1, 100), n_positive = *rc::gen::inRange(0, n + 1);
    const double level = x / 7.0;
    text += fmt::format("{},{},{}{}", level, n_positive, n,
                        *rc::gen::arbitrary<bool>() ? "\n" : "\r\n");
    written[level][0] += n - n_positive;
    written[level][1] += n_positive;
  }
  RC_ASSERT(only_group(text, psychometric) == written);
}

// Damaged files are read or refused with a place, and values that are read are valid.
RC_GTEST_PROP(AnswerData, DamagedFilesAreReadOrRefused, ()) {
  std::string text = "x,n_positive,n,who\n1,2,3,\"a\"\n2.5,3,3,b\n-3e1,0,4,\"b\"\n";
  const int n_damages = *rc::gen::inRange(1, 6);
  for (int i = 0; i < n_damages; ++i) {
    const auto place = *rc::gen::inRange<std::size_t>(0, text.size());
    const char with = *rc::gen::oneOf(rc::gen::element(',', '"', '\n', '-', 'e', '.', '0', '\0'),
                                      rc::gen::arbitrary<char>());
    switch (*rc::gen::inRange(0, 3)) {
      case 0:
        text[place] = with;
        break;
      case 1:
        text.insert(place, 1, with);
        break;
      default:
        text.erase(place, 1);
    }
  }
  try {
    for (const AnswerGroup& group :
         parse_answers(text, "f", {FitModel::psychometric, "who", false}))
      for (const auto& [level, n] : group.answers) {
        RC_ASSERT(std::isfinite(level));
        RC_ASSERT(n[0] >= 0 && n[1] >= 0 && n[2] == 0 && n[0] + n[1] > 0);
      }
  } catch (const InvalidFile& error) {
    for (const Mistake& mistake : error.mistakes())
      RC_ASSERT(mistake.place.line > 0 && mistake.place.column > 0 && !mistake.message.empty());
  } catch (const Error& error) {
    RC_ASSERT(error.exit_code() == ExitCode::usage);
  }
}

}  // namespace
}  // namespace heft
