// Judgments: means, geometric means and shares of answers, computed by hand.
#include <gmock/gmock.h>

#include <cmath>

#include "analysis/Figures.h"
#include "analysis/MadeUpSessions.h"
#include "analysis/charts/Charts.h"

namespace heft {
namespace {

using namespace made_up;
using testing::HasSubstr;

FormQuestion question(QuestionKind kind, double least = 0) {
  FormQuestion asked;
  asked.key = "asked";
  asked.kind = kind;
  asked.least = least;
  asked.most = 1000;
  asked.choices = {{"same", "Same"}, {"different", "Different"}};
  return asked;
}

Attempt& add_judgment(SessionData& data, const std::vector<double>& masses_g, double value) {
  Attempt& attempt = add_attempt(data, "judgment", masses_g);
  attempt.trial.plan.block = "pairs";
  attempt.trial.plan.condition = "C2";
  attempt.trial.outcome = "judged";
  attempt.trial.value = value;
  return attempt;
}

// Answers for 100 g: 1 and 9 by one person, 4 by the other; for 100 and 200 g: 100, and 900.
std::vector<SessionData> two_people(const FormQuestion& asked) {
  SessionData one = session(1, "one"), other = session(2, "other");
  for (SessionData* data : {&one, &other}) data->judgments["pairs"] = {asked};
  add_judgment(one, {100}, 1);
  add_judgment(one, {100}, 9);
  add_judgment(one, {200, 100}, 100);
  add_judgment(other, {100}, 4);
  add_judgment(other, {100, 200}, 900);
  add_judgment(other, {100}, 777).trial.status = TrialStatus::voided;
  add_attempt(other, "estimation", {100}).trial.value = 777;
  return {one, other};
}

TEST(JudgmentMeans, AreOfEachParticipantsMeanByCubesInAnyOrder) {
  const Summary summary = summarized(two_people(question(QuestionKind::slider)));
  const StudyEstimate light = figure(summary, "judgment_mean", {{"masses_g", "100"}});
  EXPECT_DOUBLE_EQ(*light.value, ((1 + 9) / 2.0 + 4) / 2);
  EXPECT_DOUBLE_EQ(*light.sd, 1 / std::sqrt(2));  // of 5 and 4
  // Student's t of one degree is 12.706.
  EXPECT_NEAR(*light.high - *light.value, 12.7062 / 2, 1e-4);
  EXPECT_EQ(light.n, 2);
  EXPECT_EQ(light.n_trials, 3);
  EXPECT_EQ(light.method, "arithmetic, Student's t");
  EXPECT_EQ(light.text_at("question"), "asked");
  EXPECT_EQ(*figure(summary, "judgment_mean", {{"masses_g", "100, 200"}}).value, 500);
  EXPECT_EQ(*figure(summary, "judgment_mean", {{"masses_g", "100"}, {"participant", "one"}}).value,
            5);
  EXPECT_THAT(readable(summary), HasSubstr("Judgments: mean answers by cubes"));
}

TEST(JudgmentMeans, AreGeometricWhereTheQuestionTakesOnlyNumbersAboveZero) {
  const Summary summary = summarized(two_people(question(QuestionKind::number, 0.1)));
  const StudyEstimate light = figure(summary, "judgment_mean", {{"masses_g", "100"}});
  EXPECT_NEAR(*light.value, std::sqrt(3.0 * 4), 1e-9);
  EXPECT_NEAR(*light.value * *light.value, *light.low * *light.high, 1e-6);
  EXPECT_EQ(light.method, "geometric, Student's t");
  const Summary from_zero = summarized(two_people(question(QuestionKind::number, 0)));
  EXPECT_EQ(*figure(from_zero, "judgment_mean", {{"masses_g", "100"}}).value, 4.5);
}

// Names of many sets of cubes would overlap beside each other.
TEST(JudgmentMeans, OfManySetsHaveTurnedNamesInTheChart) {
  for (const std::size_t n_sets : {2u, 9u}) {
    SessionData data = session(1, "a");
    data.judgments["pairs"] = {question(QuestionKind::slider)};
    for (std::size_t i = 1; i <= n_sets; ++i)
      add_judgment(data, {100, 200, 300.0 + 100 * static_cast<double>(i)}, 5);
    std::string script;
    for (const Chart& chart : charts_of(summarized({data})))
      if (chart.name == "judgment") script = chart.script;
    EXPECT_EQ(script.find("set xtics scale 0 rotate") != std::string::npos, n_sets > 2) << script;
  }
}

TEST(JudgmentMeans, DoNotEnterMagnitudeEstimation) {
  SessionData data = session(1, "one");
  data.judgments["pairs"] = {question(QuestionKind::number, 1)};
  add_judgment(data, {100}, 5);
  const Summary summary = summarized({data});
  EXPECT_FALSE(figure(summary, "estimation_mean").measure);
  EXPECT_DOUBLE_EQ(*figure(summary, "judgment_mean").value, 5);
  EXPECT_FALSE(figure(summary, "judgment_mean").low) << "of one person there is no interval";
}

TEST(JudgmentMeans, OfCubesWithTheirOwnFrictionAreApart) {
  SessionData data = session(1, "one");
  add_judgment(data, {100}, 5).cubes[0].table_friction = 0.2;
  add_judgment(data, {100}, 7).cubes[0].table_friction = 0.8;
  const Summary summary = summarized({data});
  EXPECT_EQ(*figure(summary, "judgment_mean", {{"masses_g", "100 (0.2)"}}).value, 5);
  EXPECT_EQ(*figure(summary, "judgment_mean", {{"masses_g", "100 (0.8)"}}).value, 7);
}

TEST(JudgmentShares, AreOfWordsInTheQuestionsOrder) {
  std::vector<SessionData> sessions{session(1, "one"), session(2, "other")};
  for (SessionData& data : sessions) {
    data.judgments["pairs"] = {question(QuestionKind::choice)};
    for (int i = 0; i < 4; ++i)
      add_judgment(data, {100, 200}, data.session.session_id == 1 && i < 3 ? 1 : 2).trial.outcome =
          "chosen";
    for (int i = 0; i < 2; ++i) add_judgment(data, {100, 100}, 1).trial.outcome = "chosen";
  }
  const Summary summary = summarized(sessions);
  EXPECT_FALSE(figure(summary, "judgment_mean").measure) << "places of words have no mean";
  const auto of = [&](const char* masses, const char* answer) {
    return figure(summary, "judgment_share", {{"masses_g", masses}, {"answer", answer}});
  };
  EXPECT_EQ(*of("100, 200", "same").value, 100 * 3.0 / 8);
  EXPECT_EQ(of("100, 200", "different").n_hits, 5);
  EXPECT_EQ(*of("100, 100", "different").value, 0) << "an answer that no one gave";
  EXPECT_EQ(of("100, 100", "same").n, 2);
  EXPECT_THAT(readable(summary), HasSubstr("\"different\""));
  for (SessionData& data : sessions) data.judgments.clear();
  EXPECT_EQ(*figure(sessions, "judgment_share", {{"masses_g", "100, 200"}, {"answer", "1"}}).value,
            100 * 3.0 / 8)
      << "without the question answers are named by their places";
}

TEST(JudgmentMeans, OfEqualAnswersHaveNoInterval) {
  SessionData one = session(1, "one"), other = session(2, "other");
  for (SessionData* data : {&one, &other}) add_judgment(*data, {100}, 3);
  const StudyEstimate mean = figure({one, other}, "judgment_mean", {{"participant", ""}});
  EXPECT_EQ(*mean.value, 3);
  EXPECT_FALSE(mean.low || mean.high) << "an interval of no width";
}

// The heavier comparison is on either side, and always chosen.
SessionData paired_by_procedure() {
  SessionData data = session(1, "one");
  FormQuestion asked = question(QuestionKind::choice);
  asked.choices = {{"l", "Left"}, {"r", "Right"}};
  data.judgments["pairs"] = {asked, {{"l", Meaning::left}, {"r", Meaning::right}}};
  for (const int reference_slot : {1, 2}) {
    Attempt& attempt = add_judgment(data, {200, 250}, reference_slot == 1 ? 2 : 1);
    attempt.trial.outcome = "chosen";
    attempt.trial.plan.staircase = "pair";
    attempt.trial.plan.reference_g = 200;
    attempt.trial.plan.reference_slot = reference_slot;
    attempt.trial.plan.level_g = 50;
  }
  return data;
}

TEST(JudgmentShares, OfAProceduresPairsAreOfTheCubesNotOfTheirSides) {
  const Summary summary = summarized({paired_by_procedure()});
  const auto of = [&](const char* answer) {
    return figure(summary, "judgment_share", {{"answer", answer}, {"reference_g", "200"}});
  };
  EXPECT_EQ(of("comparison").value, 100);
  EXPECT_EQ(of("reference").value, 0);
  EXPECT_FALSE(of("l").measure);
}

TEST(JudgmentShares, AreNoFindingWhereAThresholdIs) {
  const auto mentioned = [](const SessionData& data) {
    return readable(summarized({data})).find("Judgment \"pairs\"") != std::string::npos;
  };
  SessionData data = paired_by_procedure();
  EXPECT_FALSE(mentioned(data));
  data.without_jnd = {"pair"};
  EXPECT_TRUE(mentioned(data)) << "of constant stimuli there is no threshold";
}

}  // namespace
}  // namespace heft
