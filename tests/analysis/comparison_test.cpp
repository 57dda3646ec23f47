// Wrong cubes, false alarms, response times and voids.
#include "analysis/Comparison.h"

#include <gmock/gmock.h>

#include "MadeUpSessions.h"
#include "analysis/Tables.h"
#include "analysis/Timing.h"

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
  const SessionData data = comparisons();
  const ComparisonSummary summary = comparisons_of({&data, 1});
  EXPECT_EQ(summary.wrong_cube.trials.n_trials, 2);
  EXPECT_EQ(summary.wrong_cube.percent, 50);
}

TEST(Comparison, FalseAlarmsAreOfCatchTrialsAndZeroLevelsOfStaircases) {
  const SessionData data = comparisons();
  const ComparisonSummary summary = comparisons_of({&data, 1});
  EXPECT_EQ(summary.false_alarm.trials.n_trials, 3);
  EXPECT_EQ(summary.false_alarm.trials.n_hits, 1);
  EXPECT_EQ(summary.at_zero.trials.n_trials, 1);
  EXPECT_EQ(summary.at_zero.trials.n_hits, 1);
  ASSERT_EQ(summary.by_reference.size(), 1);
  EXPECT_EQ(summary.by_reference[0].difference.trials.n_trials, 4);
  EXPECT_EQ(summary.by_reference[0].difference.trials.n_hits, 3);
}

TEST(Comparison, LevelsAreWithoutCatchTrials) {
  const SessionData data = comparisons();
  const ComparisonSummary summary = comparisons_of({&data, 1});
  ASSERT_EQ(summary.by_level.size(), 3);
  EXPECT_EQ(summary.by_level[0].level_g, 0);
  EXPECT_EQ(summary.by_level[0].n_trials, 1);
  EXPECT_EQ(summary.by_level[1].level_g, 125);
  EXPECT_EQ(summary.by_level[1].difference.percent, 50);
  EXPECT_EQ(summary.by_level[1].wrong_cube.percent, 100);
}

TEST(Comparison, NothingIsFoundInNothing) {
  const ComparisonSummary summary = comparisons_of(ComparisonTrials());
  EXPECT_FALSE(summary.wrong_cube.percent.has_value());
  EXPECT_TRUE(summary.by_reference.empty());
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
  const auto times = response_times({&data, 1});
  ASSERT_EQ(times.size(), 1);
  EXPECT_EQ(times[0].n_trials, 3);
  EXPECT_DOUBLE_EQ(*times[0].median_s, 2);
}

TEST(Timing, VoidsByReasonMostFrequentFirst) {
  SessionData data = session(1, "a");
  for (const char* reason : {"board lost", "interrupted", "interrupted"}) {
    Attempt& attempt = add_sorting(data, "C1", "correct");
    attempt.trial.status = TrialStatus::voided;
    attempt.trial.void_reason = reason;
  }
  const auto voids = voids_of({&data, 1});
  ASSERT_EQ(voids.size(), 2);
  EXPECT_EQ(voids[0].reason, "interrupted");
  EXPECT_EQ(voids[0].n, 2);
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
    const Summary summary = summarize({"x.db", choosers(n)}, "");
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
