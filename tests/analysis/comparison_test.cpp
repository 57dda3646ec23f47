// Wrong cubes, false alarms, response times and voids.
#include <gmock/gmock.h>

#include "Figures.h"
#include "MadeUpSessions.h"

namespace heft {
namespace {

using namespace made_up;

SessionData comparisons() {
  SessionData data = session(1, "a");
  choose(add_comparison(data, "15g", 15, 175), true);
  choose(add_comparison(data, "15g", 15, 125), false);
  choose(add_comparison(data, "15g", 15, 0), false);  // no cube is the lighter one
  add_comparison(data, "15g", 15, 125);
  for (bool alarm : {true, false, false}) {
    Attempt& attempt = add_comparison(data, "", 15, 0);
    attempt.trial.plan.is_catch = true;
    if (alarm) choose(attempt, false);
  }
  return data;
}

TEST(Comparison, WrongCubesAreOfChoicesBetweenDifferentCubes) {
  const StudyEstimate wrong = figure({comparisons()}, "incorrect_choice", {{"over", "all"}});
  EXPECT_EQ(wrong.n_trials, 2);
  EXPECT_EQ(wrong.value, 50);
}

TEST(Comparison, FalseAlarmsAreOfCatchTrialsAndZeroLevelsOfStaircases) {
  const Summary summary = summarized({comparisons()});
  for (const char* over : {"each", "all"}) {
    const auto is = [&](const char* measure, int n_hits, int n_trials) {
      const StudyEstimate found = figure(summary, measure, {{"over", over}});
      EXPECT_EQ(found.n_trials, n_trials) << measure << ' ' << over;
      EXPECT_EQ(found.n_hits, n_hits) << measure << ' ' << over;
    };
    is("false_alarm", 1, 3);
    is("choice_at_zero", 1, 1);
    is("choice", 3, 4);
  }
}

TEST(Comparison, LevelsAreWithoutCatchTrials) {
  const Summary summary = summarized({comparisons()});
  const auto trials = estimates_of(summary.estimates, "comparisons", {{"over", "level"}});
  ASSERT_EQ(trials.size(), 3u);
  EXPECT_EQ(trials[0]->text_at("level_g"), "0");
  EXPECT_EQ(trials[0]->value, 1);
  EXPECT_EQ(trials[1]->text_at("level_g"), "125");
  EXPECT_EQ(figure(summary, "choice", {{"level_g", "125"}}).value, 50);
  EXPECT_EQ(figure(summary, "incorrect_choice", {{"level_g", "125"}}).value, 100);
}

TEST(Comparison, NothingIsFoundInNothing) {
  const Summary summary = summarized({});
  EXPECT_FALSE(figure(summary, "incorrect_choice").value.has_value());
  EXPECT_TRUE(estimates_of(summary.estimates, "choice", {{"over", "each"}}).empty());
}

TEST(Timing, ResponseTimeIsWithoutPausesAndLosses) {
  TrialRow trial;
  EXPECT_FALSE(response_time_s(trial).has_value());
  trial.shown_s = 10;
  trial.validated_s = 20;
  trial.paused_s = 2;
  trial.lost_s = 0.5;
  EXPECT_DOUBLE_EQ(*response_time_s(trial), 7.5);
}

TEST(Timing, MediansPerTaskAndConditionOfCompletedTrials) {
  SessionData data = session(1, "a");
  for (double time_s : {1.0, 9.0, 2.0}) {
    Attempt& attempt = add_sorting(data, "C1", "correct");
    attempt.trial.shown_s = 100;
    attempt.trial.validated_s = 100 + time_s;
  }
  data.attempts.push_back(data.attempts.back());
  data.attempts.back().trial.status = TrialStatus::voided;
  const Summary summary = summarized({data});
  const auto times = estimates_of(summary.estimates, "response_time");
  ASSERT_EQ(times.size(), 1u);
  EXPECT_EQ(times[0]->n_trials, 3);
  EXPECT_DOUBLE_EQ(*times[0]->value, 2);
}

TEST(Timing, VoidsByReasonMostFrequentFirst) {
  SessionData data = session(1, "a");
  for (const char* reason : {"board lost", "interrupted", "interrupted"}) {
    Attempt& attempt = add_sorting(data, "C1", "correct");
    attempt.trial.status = TrialStatus::voided;
    attempt.trial.void_reason = reason;
  }
  const Summary summary = summarized({data});
  const auto voids = estimates_of(summary.estimates, "void_attempts");
  ASSERT_EQ(voids.size(), 2u);
  EXPECT_EQ(voids[0]->text_at("reason"), "interrupted");
  EXPECT_EQ(voids[0]->value, 2);
}

std::vector<SessionData> choosers(int n) {
  std::vector<SessionData> sessions;
  for (int i = 0; i < n; ++i) {
    sessions.push_back(session(i + 1, std::to_string(100 + i)));
    Attempt& attempt = add_comparison(sessions.back(), "s", 200, 50);
    if (i == 0) choose(attempt, true);
  }
  return sessions;
}

TEST(ChoiceCurves, EachParticipantIsALineUntilThereAreTooMany) {
  const auto lines = [](int n) {
    const Summary summary = summarized(choosers(n));
    std::map<std::string, double> percent;
    for (const StudyEstimate& one : all_estimates(summary))
      if (one.measure->name == "chosen_heavier" && !one.participant.empty())
        percent[one.participant] = *one.value;
    return percent;
  };
  EXPECT_EQ(lines(2), (std::map<std::string, double>{{"100", 100}, {"101", 0}}));
  EXPECT_TRUE(lines(61).empty());
}

}  // namespace
}  // namespace heft
