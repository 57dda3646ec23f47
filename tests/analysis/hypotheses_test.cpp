// Verdicts on the paper's hypotheses, and when they are inconclusive.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "MadeUpSessions.h"
#include "analysis/Analysis.h"
#include "analysis/dataset/Summary.h"
#include "analysis/report/Notes.h"
#include "analysis/report/Report.h"
#include "nlohmann/json.hpp"

namespace heft {
namespace {

using namespace made_up;
using testing::HasSubstr;
using testing::Not;

// People with these numbers of correct answers in `n_answered` C1 trials each; the rest of
// `n_trials` are "I don't know".
std::vector<SessionData> c1_study(const std::vector<int>& n_right, int n_answered, int n_trials) {
  std::vector<SessionData> sessions;
  for (int right : n_right) {
    const auto id = static_cast<std::int64_t>(sessions.size()) + 1;
    sessions.push_back(session(id, std::to_string(id)));
    add_sortings(sessions.back(), "C1", "correct", right);
    add_sortings(sessions.back(), "C1", "incorrect", n_answered - right);
    add_sortings(sessions.back(), "C1", "dont_know", n_trials - n_answered);
  }
  return sessions;
}

Hypothesis e1_h1(const std::vector<SessionData>& sessions) {
  return summarize({"x.db", sessions}, "").hypotheses.at(0);
}

TEST(HypothesisOfC1, IsSupportedByEquivalenceToChance) {
  std::vector<int> n_right;
  for (int i = 0; i < 40; ++i) n_right.push_back(i % 3);  // 16.7 % of 6
  const Summary summary = summarize({"x.db", c1_study(n_right, 6, 8)}, "");
  EXPECT_EQ(summary.hypotheses.at(0).verdict, HypothesisVerdict::supported);
  const std::vector<std::string> findings = findings_of(summary);
  EXPECT_THAT(findings.at(0), HasSubstr("25 % ["));
  EXPECT_THAT(findings.at(0), HasSubstr("] were \"I don't know\", and 16 % ["));
  EXPECT_THAT(findings.at(0), HasSubstr("] of the others were correct"));
  EXPECT_EQ(findings.at(1), "Answers in C1 are equivalent to chance (within 10 points).");
}

TEST(HypothesisOfC1, IsLeftOpenByFewData) {
  const Hypothesis few = e1_h1(c1_study({0, 1, 2, 1}, 5, 10));
  EXPECT_EQ(few.verdict, HypothesisVerdict::inconclusive);  // p > .05 is no equivalence
  EXPECT_THAT(few.why, HasSubstr("too wide"));
  EXPECT_THAT(few.why, Not(HasSubstr("inconclusive"))) << "the verdict is beside it";
}

TEST(HypothesisOfC1, IsNotSupportedWhereMostAreRight) {
  EXPECT_EQ(e1_h1(c1_study({4, 5, 4, 3, 5, 4, 4, 5, 3, 4}, 5, 5)).verdict,
            HypothesisVerdict::not_supported);
}

TEST(HypothesisOfC1, CountsDontKnowApart) {
  const Hypothesis none_answered = e1_h1(c1_study({0, 0, 0}, 0, 5));
  EXPECT_EQ(none_answered.verdict, HypothesisVerdict::inconclusive);
  EXPECT_THAT(none_answered.why, HasSubstr("answered a C1 trial"));
}

TEST(HypothesesOfE2, AreNotJudgedByTheJnd) {
  std::vector<SessionData> sessions;
  for (int i = 1; i <= 13; ++i) {
    sessions.push_back(session(i, std::to_string(i)));
    for (double reference_g : {15.0, 200.0, 800.0})
      add_staircase(sessions.back(), std::to_string(reference_g), reference_g, reference_g + i);
  }
  const Summary summary = summarize({"x.db", sessions}, "");
  EXPECT_EQ(summary.hypotheses[3].verdict, HypothesisVerdict::inconclusive);
  EXPECT_THAT(summary.hypotheses[3].why, HasSubstr("at 15 g there is no threshold ("));
  EXPECT_EQ(summary.hypotheses[4].verdict, HypothesisVerdict::inconclusive);
}

TEST(DeclaredHypotheses, WithoutTheirTrialsAreNamed) {
  SessionData data = session(1, "1");
  data.plan.emplace().tested = {true, true, false, false, false};
  add_sorting(data, "C2", "correct").cubes = cubes({15, 300, 800});
  EXPECT_EQ(inconclusive_sentence(summarize({"x.db", {data}}, "")),
            "Declared but not tested, without trials of the paper's masses and technique: "
            "E1-H1, E1-H2.");
}

std::vector<std::string> untestable(const std::string& blocks) {
  const Protocol protocol = parse_protocol(
      "title = \"t\"\n[analysis]\nE1-H1 = true\nE1-H2 = true\nE1-H3 = true\nE2-H1 = true\n" +
          blocks,
      "t.toml");
  std::vector<std::string> names;
  for (const auto& [name, needs] : published::untestable_in(protocol)) names.emplace_back(name);
  return names;
}

TEST(DeclaredHypotheses, NeedThePapersTrials) {
  using testing::ElementsAre;
  const auto sorting = [](const char* masses_g, const char* trials) {
    return fmt::format("[[block]]\nkind = \"sorting\"\nname = \"s\"\nmasses_g = {}\ntrials = {}\n",
                       masses_g, trials);
  };
  const auto staircase = [](int reference_g) {
    return fmt::format(
        "[[block.staircase]]\nname = \"{0}\"\nreference_g = {0}\nstart = 100\nstep = 10\nfloor = "
        "0\n",
        reference_g);
  };
  const auto comparison = [](const std::string& keys) {
    return "[[block]]\nkind = \"comparison\"\nname = \"c\"\n" + keys;
  };
  EXPECT_THAT(untestable(sorting("[15, 200, 800]", "{ C2 = 2 }")),
              ElementsAre("E1-H1", "E1-H3", "E2-H1"));
  EXPECT_THAT(untestable(sorting("[15, 200, 800]", "{ C2 = 2 }\ntable_friction = [1, 0.8, 0.8]")),
              testing::Contains("E1-H2"));
  EXPECT_THAT(untestable(sorting("[15, 250, 800]", "{ C1 = 2, C2 = 2 }")),
              ElementsAre("E1-H1", "E1-H2", "E1-H3", "E2-H1"));
  EXPECT_THAT(
      untestable("[[block]]\nkind = \"introduction\"\nname = \"i\"\nmasses_g = [800, 15]\n"),
      ElementsAre("E1-H1", "E1-H2", "E2-H1"));
  const std::string two = staircase(15) + staircase(200);
  EXPECT_THAT(untestable(comparison(two)), ElementsAre("E1-H1", "E1-H2", "E1-H3"));
  EXPECT_THAT(untestable(comparison(staircase(15) + staircase(100))), testing::Contains("E2-H1"));
  EXPECT_THAT(untestable(comparison("answers = \"heavier\"\n" + two)), testing::Contains("E2-H1"));
  EXPECT_THAT(untestable(comparison("condition = \"C1\"\n" + two)), testing::Contains("E2-H1"));
}

TEST(HypothesesJson, IsByName) {
  const auto report = nlohmann::json::parse(as_json(summarize({"x.db", {}}, "")));
  for (const char* name : {"E1-H1", "E1-H2", "E1-H3", "E2-H1", "E2-H2"})
    EXPECT_EQ(report["hypotheses"][name]["verdict"], "not tested") << name;
}

}  // namespace
}  // namespace heft
