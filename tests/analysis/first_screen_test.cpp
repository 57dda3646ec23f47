// The summary on one terminal screen: its size, and that it names what needs attention.
#include <gmock/gmock.h>

#include <sstream>

#include "MadeUpSessions.h"
#include "analysis/Analysis.h"
#include "analysis/report/Notes.h"
#include "analysis/report/Report.h"
#include "analysis/report/Tables.h"

namespace heft {
namespace {

using namespace made_up;
using testing::Contains;
using testing::Each;
using testing::HasSubstr;
using testing::Not;
using testing::SizeIs;

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::string screen_of(const std::vector<SessionData>& sessions) {
  return first_screen(summarize({"x.db", sessions}, "heft analyse"),
                      {{}, {}, {{"All tables", "heft analyse --db x.db --tables"}}});
}

// On one line, as wrapping may divide any sentence.
std::string unwrapped(const std::string& screen) {
  std::string text;
  for (const std::string& line : lines_of(screen)) {
    const auto start = line.find_first_not_of(' ');
    if (start != std::string::npos) text += (text.empty() ? "" : " ") + line.substr(start);
  }
  return text;
}

TEST(FirstScreen, CountsTheTrialsOfOneParticipantAndComparesConditions) {
  SessionData data = session(1, "a", Purpose::simulated, "simulated");
  add_sortings(data, "C1", "incorrect", 4);
  add_sortings(data, "C1", "dont_know", 1);
  add_sortings(data, "C2", "correct", 5);
  EXPECT_THAT(unwrapped(screen_of({data})),
              HasSubstr("Sorting: with decoupling (C2) all 5 were correct, 100 % [48, 100]; "
                        "without decoupling (C1) none of 4 were correct, 0 % [0, 60], and 1 "
                        "\"I don't know\". Chance is 17 %."));
}

TEST(FirstScreen, NamesOtherTechniquesByTheirCondition) {
  SessionData data = session(1, "a");
  data.published_conditions.clear();
  add_sortings(data, "C2", "correct", 2);
  const std::string text = unwrapped(screen_of({data}));
  EXPECT_THAT(text, HasSubstr("Sorting: in C2 all 2 were correct"));
  EXPECT_THAT(text, Not(HasSubstr("decoupling")));
}

TEST(FirstScreen, ShowsWhatDeservesAttention) {
  SessionData data = session(1, "a");
  data.session.state = SessionState::aborted;
  Attempt& voided = add_sorting(data, "C1", "correct");
  voided.trial.status = TrialStatus::voided;
  voided.trial.void_reason = "camera stalled";
  add_sorting(data, "C1", "correct").trial.lost_s = 2.5;
  data.noted = {{1, event_kind<Deviation>, "the lamp fell"}};
  add_staircase(data, "15g", 15, 1400);
  data.estimates.back().censored = Censored::above;
  data.estimates.back().n_ceiling = 3;
  const std::vector<std::string> found = attention_sentences(summarize({"x.db", {data}}, ""));
  for (const char* part : {"One participant: intervals", "Not finished: session 1 (a, aborted)",
                           "1 of 3 attempts was void and presented again: camera stalled (1).",
                           "Tracking was lost in 1 of 3 attempts, for 2.5 s in all.",
                           "2 of 2 responses were anticipatory", "deviation (1)",
                           "1 of 1 finished staircases has a censored JND",
                           "The threshold is not identifiable at 15 g in"})
    EXPECT_THAT(found, Contains(HasSubstr(part)));
}

TEST(FirstScreen, NamesExcludedParticipants) {
  SessionData kept = session(1, "a"), left_out = session(2, "b");
  add_sorting(kept, "C2", "correct");
  add_sorting(left_out, "C2", "correct");
  left_out.exclusion.anticipatory_responses = 0;
  EXPECT_THAT(unwrapped(screen_of({kept, left_out})),
              HasSubstr("Excluded from all figures by the rules of the protocol: b"));
}

TEST(FirstScreen, OfParticipantsWhoAreAllExcludedSaysWhyNothingIsTested) {
  SessionData data = session(1, "a");
  data.plan.emplace().tested = {true, false, false, false, false};
  add_sorting(data, "C1", "correct");
  data.exclusion.anticipatory_responses = 0;
  const Summary summary = summarize({"x.db", {data}}, "");
  EXPECT_THAT(unwrapped(first_screen(summary, {})),
              HasSubstr("1 session of 1 participant, 0 of them in the figures, in x.db"));
  EXPECT_EQ(inconclusive_sentence(summary),
            "Declared but not tested, because no participant is left: E1-H1.");
  EXPECT_EQ(summary.hypotheses.front().why, "no participant is left after exclusions");
}

TEST(FirstScreen, HasNothingThatTheTablesLeaveOut) {
  SessionData data = session(1, "a");
  data.session.state = SessionState::aborted;
  add_sorting(data, "C1", "correct").trial.lost_s = 2.5;
  const Summary summary = summarize({"x.db", {data}}, "");
  const std::string tables = unwrapped(readable(summary));
  ASSERT_FALSE(attention_sentences(summary).empty());
  for (const std::string& sentence : attention_sentences(summary))
    EXPECT_THAT(tables, HasSubstr("- " + sentence));
}

TEST(FirstScreen, OfNothingNamesTheLog) {
  const std::string text = screen_of({});
  EXPECT_THAT(text, HasSubstr("x.db holds no sessions."));
  EXPECT_THAT(text, Not(HasSubstr("Results")));
}

TEST(FirstScreen, WithoutCompletedTrialsHasNoResults) {
  SessionData data = session(1, "a");
  add_sorting(data, "C1", "correct").trial.status = TrialStatus::voided;
  const std::string text = unwrapped(screen_of({data}));
  EXPECT_THAT(text, HasSubstr("No trial was completed"));
}

TEST(FirstScreen, FitsATerminalHoweverMuchThereIs) {
  std::vector<SessionData> sessions;
  for (int i = 0; i < 40; ++i) {
    SessionData data = session(
        i + 1, "participant with a name that takes much space \n\x1b[2J" + std::to_string(i));
    data.session.state = SessionState::aborted;
    data.session.header.protocol_sha256 = std::to_string(i);
    for (int k = 0; k < 30; ++k) {
      const std::string condition = "\xc3\xa9\xc3\xa9 condition number " + std::to_string(k);
      add_sortings(data, condition, k % 2 ? "correct" : "incorrect", 2);
      add_staircase(data, "staircase" + std::to_string(k), 10.0 + k, 100);
      data.attempts.back().trial.plan.condition = condition;
    }
    sessions.push_back(data);
  }
  const std::vector<std::string> lines = lines_of(screen_of(sessions));
  EXPECT_LE(lines.size(), 25);
  EXPECT_THAT(lines, Each(SizeIs(testing::Le(80))));
  EXPECT_THAT(lines.back(), HasSubstr("--tables"));
}

TEST(FirstScreen, WhatWasDoneIsOneSentence) {
  SessionData data = session(1, "a");
  add_introduction(data, 1);
  Summary summary = summarize({"x.db", {data}}, "heft analyse");
  FirstScreenOptions options;
  EXPECT_THAT(first_screen(summary, options), HasSubstr("1 trial completed: 1 introduction.\n"));
  options.done = "2 min, simulated in 1 s";
  summary.integrity.words = "verified";
  EXPECT_THAT(first_screen(summary, options),
              HasSubstr("1 introduction; 2 min, simulated in 1 s; verified.\n"));
}

// Of a posterior's estimate these would be untrue.
TEST(LeadingSentences, SayWhatThePapersJndIsOnlyWhereThereIsOne) {
  const auto sentences_of = [](const std::string& method) {
    std::vector<SessionData> people;
    for (const char* name : {"a", "b", "c"}) {
      people.push_back(session(static_cast<int>(people.size()) + 1, name));
      add_staircase(people.back(), "s", 200, 80 + 10.0 * static_cast<double>(people.size()));
      people.back().attempts.back().trial.plan.condition = "C2";
      people.back().estimates.back().method = method;
    }
    return leading_sentences(summarize({"x.db", people}, ""));
  };
  EXPECT_THAT(sentences_of("mean_of_reversals"), Contains(HasSubstr("the paper's JND depends")));
  EXPECT_THAT(sentences_of("mean_of_reversals"), Contains(HasSubstr("arithmetic mean")));
  EXPECT_THAT(sentences_of("psi"), Contains(HasSubstr("JND (psi) in C2: ")));
  EXPECT_THAT(sentences_of("psi"), Each(Not(HasSubstr("paper's JND"))));
  EXPECT_THAT(sentences_of("psi"), Each(Not(HasSubstr("arithmetic mean"))));
}

}  // namespace
}  // namespace heft
