// The whole Summary: its JSON, its notes, and logs without sessions.
#include "analysis/dataset/Summary.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "MadeUpSessions.h"
#include "analysis/Analysis.h"
#include "analysis/report/Report.h"
#include "analysis/report/Tables.h"

namespace heft {
namespace {

using namespace made_up;
using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

SessionData full_session(std::int64_t id, const std::string& participant) {
  SessionData data = session(id, participant);
  add_introduction(data, 1);
  add_sortings(data, "C1", "dont_know", 5);
  add_sortings(data, "C2", "correct", static_cast<int>(id) + 1);
  add_sortings(data, "C2", "incorrect", 1);
  add_staircase(data, "15g", 15, 100 + 10 * static_cast<double>(id));
  add_staircase(data, "200g", 200, 200);
  return data;
}

json json_of(const std::vector<SessionData>& sessions) {
  return json::parse(as_json(summarize({"x.db", sessions}, "heft analyse --db x.db")));
}

std::string text_of(const std::vector<SessionData>& sessions) {
  return readable(summarize({"x.db", sessions}, "heft analyse --db x.db"));
}

TEST(SummaryJson, KeepsTheContract) {
  const json found = json_of({full_session(1, "a"), full_session(2, "b")});
  const json& correct = found["sorting"]["C2"]["correct"];
  EXPECT_NEAR(correct["mean"], (200.0 / 3 + 75) / 2, 1e-9);
  EXPECT_NEAR(correct["sd"], (75 - 200.0 / 3) / std::sqrt(2), 1e-9);
  EXPECT_TRUE(correct["low"].is_number());
  EXPECT_TRUE(correct["high"].is_number());
  EXPECT_EQ(correct["published"], 78.5);
  EXPECT_EQ(found["sorting"]["C1"]["none"]["mean"], 100);
  EXPECT_EQ(found["sorting"]["C1"]["none"]["published"], 38.5);
  EXPECT_TRUE(found["sorting"]["C1"]["answered"]["correct"]["mean"].is_null());
  EXPECT_EQ(found["sorting"]["C2"]["swapped"].size(), 4);
  EXPECT_EQ(found["introduction"]["first_try"]["percent"], 100);
  ASSERT_EQ(found["jnd"].size(), 2);
  EXPECT_EQ(found["jnd"][0]["reference_g"], 15);
  EXPECT_EQ(found["jnd"][0]["mean_g"], 115);
  EXPECT_NEAR(found["jnd"][0]["sd_g"], std::sqrt(50), 1e-12);
  EXPECT_TRUE(found["jnd"][0]["low_g"].is_null());  // it needs three participants
  EXPECT_EQ(found["jnd"][0]["paper_mean_g"], 115);
  EXPECT_NEAR(found["jnd"][0]["paper_sd_g"], std::sqrt(50), 1e-12);
  EXPECT_EQ(found["jnd"][0]["paper_n"], 2);
  EXPECT_EQ(found["jnd"][0]["published_g"], 172.3);
  EXPECT_EQ(found["jnd"][1]["sd_g"], 0);
  EXPECT_TRUE(found["jnd"][1]["low_g"].is_null());
  EXPECT_EQ(found["simulated"], false);
}

TEST(SummaryJson, OfNothingHasTheSameKeys) {
  const json empty = json_of({}), full = json_of({full_session(1, "a")});
  for (const auto& [key, value] : full.items()) EXPECT_TRUE(empty.contains(key)) << key;
  EXPECT_EQ(empty["sorting"], json::object());  // conditions come from the log
  EXPECT_EQ(empty["jnd"], json::array());
  EXPECT_TRUE(empty["introduction"]["first_try"]["percent"].is_null());
}

TEST(SummaryJson, NeverHoldsNanOrInfinity) {
  SessionData data = full_session(1, "a");
  data.estimates[0].jnd_g = std::numeric_limits<double>::infinity();
  const std::string text = as_json(summarize({"x.db", {data}}, ""));
  EXPECT_THAT(text, Not(HasSubstr("inf")));
  EXPECT_THAT(text, Not(HasSubstr("nan")));
  EXPECT_TRUE(json::parse(text)["jnd"][0]["mean_g"].is_null());
}

TEST(SummaryJson, NamesThatAreNoUtf8DoNotBreakIt) {
  EXPECT_NO_THROW(json_of({full_session(1, "\xff\xfe")}));
}

TEST(Summary, SimulatedFiguresSayEverywhereThatTheyAre) {
  SessionData data = full_session(1, "a");
  data.session.header.purpose = Purpose::simulated;
  data.setups[0].setup.responder = Plug{"simulated"};
  const Summary summary = summarize({"x.db", {data}}, "");
  EXPECT_TRUE(summary.simulated());
  for (const Table& table : filled(tables_at(summary, all_csv_places))) {
    EXPECT_THAT(table.title, HasSubstr("(simulated)"));
    EXPECT_THAT(as_csv(table, summary.data), HasSubstr("\nsimulated,"));
  }
  EXPECT_EQ(json::parse(as_json(summary))["simulated"], true);
}

TEST(Summary, HumanFiguresDoNotSayTheyAreSimulated) {
  EXPECT_THAT(text_of({full_session(1, "a")}), Not(HasSubstr("simulated")));
}

TEST(Summary, SaysWhatIsUnfinishedRepeatedAndOfSeveralProtocols) {
  SessionData first = full_session(1, "a"), again = full_session(2, "a");
  again.session.state = SessionState::paused;
  again.session.header.protocol_sha256 = "fedcba9876543210";
  const std::string text = text_of({first, again});
  EXPECT_THAT(text, HasSubstr("Not finished: session 2 (a, paused)"));
  EXPECT_THAT(text, HasSubstr("More than one session: a (2 sessions)"));
  EXPECT_THAT(text, HasSubstr("The sessions ran 2 protocols"));
}

TEST(Summary, NamesSortingsOfDifferentMassesThatAreOneFigure) {
  SessionData data = session(1, "a");
  add_sorting(data, "C1", "correct").cubes = cubes({800, 15, 200});
  add_sorting(data, "C1", "correct").cubes = cubes({15, 200, 800});
  add_sorting(data, "C2", "correct").cubes = cubes({15, 200, 800});
  EXPECT_THAT(text_of({data}), Not(HasSubstr("different masses")));
  add_sorting(data, "C2", "correct").cubes = cubes({50, 60});
  EXPECT_THAT(text_of({data}),
              HasSubstr("Sortings of different masses are analyzed together: in C2 "
                        "of 15, 200, 800 g; of 50, 60 g."));
}

TEST(Summary, AnOrdinaryLogHasNoNotes) {
  EXPECT_TRUE(summarize({"x.db", {full_session(1, "a"), full_session(2, "b")}}, "").notes.empty());
}

TEST(Summary, NothingIsSaidClearly) {
  EXPECT_THAT(text_of({}), HasSubstr("x.db holds no sessions."));
  SessionData data = session(1, "a");
  add_sorting(data, "C1", "correct").trial.status = TrialStatus::voided;
  const std::string text = text_of({data});
  EXPECT_THAT(text, HasSubstr("No trial was completed"));
  EXPECT_THAT(text, Not(HasSubstr("JND"))) << "no block of comparisons was begun";
}

TEST(Summary, HypothesesCarryTheirExperiment) {
  std::vector<std::string> names;
  for (const Hypothesis& hypothesis : summarize({"x.db", {full_session(1, "a")}}, "").hypotheses) {
    names.push_back(hypothesis.name);
    EXPECT_FALSE(hypothesis.condition.empty());
    EXPECT_FALSE(hypothesis.figures.empty());
    EXPECT_FALSE(hypothesis.why.empty());
  }
  EXPECT_THAT(names, ElementsAre("E1-H1", "E1-H2", "E1-H3", "E2-H1", "E2-H2"));
}

TEST(Hypotheses, AreJudgedWithThePapersMassesAlone) {
  SessionData data = session(1, "a");
  add_sorting(data, "C2", "correct");
  const auto hypothesis = [&] { return summarize({"log.db", {data}}, "").hypotheses[1]; };
  EXPECT_EQ(hypothesis().figures.back(), "a random order is right in 16.7 % of trials");
  EXPECT_EQ(hypothesis().condition, "C2");
  add_sorting(data, "C2", "correct").cubes = cubes({15, 100, 250, 800});
  EXPECT_EQ(hypothesis().condition, "");
  EXPECT_THAT(hypothesis().why, HasSubstr("the paper's masses"));
}

TEST(Summary, RisingJndsAreCountedByParticipant) {
  SessionData rising = full_session(1, "a"), falling = full_session(2, "b");
  falling.estimates[1].jnd_g = 50;
  const Summary summary = summarize({"x.db", {rising, falling}}, "");
  EXPECT_THAT(summary.hypotheses[3].figures.back(), HasSubstr("in 1 of 2 participants"));
}

TEST(Summary, ShowsTheStaircasesOfAFinishedSession) {
  SessionData running = full_session(1, "a"), finished = full_session(2, "b");
  running.session.state = SessionState::running;
  finished.attempts.back().is_reversal = true;
  const Summary summary = summarize({"x.db", {running, finished}}, "");
  const SessionTracks* tracks = example_of(summary.all_tracks);
  ASSERT_NE(tracks, nullptr);
  EXPECT_EQ(tracks->session_id, 2);
  ASSERT_EQ(tracks->tracks.size(), 2);
  EXPECT_EQ(tracks->tracks[1].jnd_g, 200);
  EXPECT_TRUE(tracks->tracks[1].points.at(0).is_reversal);
}

// With the spring that locks the orientation there is nothing to chart.
TEST(Summary, ShowsTheTurnOfTheCloneWhereItIsVisible) {
  SessionData data = session(1, "a");
  add_sortings(data, "C2", "correct", 3);  // 15, 200 and 800 g
  const std::string measure = "clone_yaw";
  for (Attempt& attempt : data.attempts) attempt.clone_yaw_deg = {{1, 0.001}, {3, 0.05}};
  EXPECT_EQ(find_estimate(summarize({"x.db", {data}}, "").estimates, measure), nullptr);
  data.attempts[0].clone_yaw_deg = {{1, 1.0}, {3, 20.0}};
  data.attempts[1].clone_yaw_deg = {{1, 3.0}};
  data.attempts[2].clone_yaw_deg.clear();
  const Summary summary = summarize({"x.db", {data}}, "");
  const auto turns = estimates_of(summary.estimates, measure);
  ASSERT_EQ(turns.size(), 2u);
  EXPECT_EQ(turns[0]->condition, "C2");
  EXPECT_EQ(turns[0]->value, 2);
  EXPECT_EQ(turns[0]->n_trials, 2);
  EXPECT_EQ(turns[1]->value, 20);
}

}  // namespace
}  // namespace heft
