// Counts of data quality.
#include "analysis/dataset/Quality.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "MadeUpSessions.h"
#include "analysis/Folds.h"

namespace heft {
namespace {

using namespace made_up;

int counted(const Quality& quality, std::string_view what) {
  return std::ranges::find(quality.counted, what, &DataQualityRow::what)->n;
}

Attempt& add_timed(SessionData& data, double level_g, double answered_s, bool touched = true) {
  Attempt& attempt = add_comparison(data, "s", 200, level_g);
  attempt.trial.shown_s = 10;
  attempt.trial.validated_s = 10 + answered_s;
  if (touched) attempt.trial.first_contact_s = 10.1;
  return attempt;
}

TEST(Quality, CountsAnswersThatCantBe) {
  SessionData data = session(1, "a");
  add_timed(data, 50, 0.2);
  add_timed(data, 50, 0.4);
  add_timed(data, 50, 3, false);
  add_timed(data, 50, 3);
  add_timed(data, 50, 0.1).trial.status = TrialStatus::voided;
  const Quality quality = quality_of({&data, 1});
  EXPECT_EQ(counted(quality, "answers earlier than 0.5 s"), 2);
  EXPECT_EQ(counted(quality, "answers faster than 0.3 s"), 1);
  EXPECT_EQ(counted(quality, "answers without contact"), 1);
  EXPECT_EQ(counted(quality, "void attempts"), 1);
}

TEST(Quality, CountsLossesByTheSizeOfTheDifference) {
  SessionData data = session(1, "a");
  add_timed(data, -50, 3);
  add_timed(data, 50, 3);
  const Quality quality = quality_of({&data, 1});
  ASSERT_EQ(quality.losses.size(), 1);
  EXPECT_EQ(quality.losses[0].difference, "over 0 to 100 g");
}

TEST(Quality, CountsLossesByLevel) {
  SessionData data = session(1, "a");
  add_timed(data, 0, 3);
  add_timed(data, 50, 3).trial.lost_s = 1.5;
  add_timed(data, 500, 3).trial.status = TrialStatus::voided;
  add_timed(data, 600, 3).trial.lost_s = 2;
  const Quality quality = quality_of({&data, 1});
  ASSERT_EQ(quality.losses.size(), 3);
  EXPECT_EQ(quality.losses[0].difference, "0 g");
  EXPECT_EQ(quality.losses[1].difference, "over 0 to 100 g");
  EXPECT_EQ(quality.losses[1].n_lost, 1);
  EXPECT_EQ(quality.losses[2].difference, "over 300 to 700 g");
  EXPECT_EQ(quality.losses[2].n_attempts, 2);
  EXPECT_EQ(quality.losses[2].n_void, 1);
  EXPECT_EQ(quality.losses[2].lost_s, 2);
}

TEST(Quality, CountsResetsByMass) {
  SessionData data = session(1, "a");
  add_sorting(data, "C2", "correct").cubes[0].n_resets = 2;
  add_sorting(data, "C2", "correct");
  const Quality quality = quality_of({&data, 1});
  ASSERT_EQ(quality.resets.size(), 3);  // 15, 200 and 800 g
  EXPECT_EQ(quality.resets[0].n_cubes, 2);
  EXPECT_EQ(quality.resets[0].n_reset, 1);
  EXPECT_EQ(quality.resets[2].n_reset, 0);
}

TEST(Quality, CountsWhatWasNoted) {
  std::vector<LoggedEvent> events(5);
  events[0].event.what = Note{"a note"};
  events[1].event.what = Deviation{"light switched on"};
  events[2].event.what = CheckResult{CheckVerdict::failed, "light", "too dark"};
  events[3].event.what = CheckResult{CheckVerdict::warning, "light", "dim"};
  events[4].event.what = CheckResult{CheckVerdict::ok, "light", "bright"};
  SessionData data = session(1, "a");
  data.events = count_events(events);
  const Quality quality = quality_of({&data, 1});
  EXPECT_EQ(counted(quality, "notes"), 1);
  EXPECT_EQ(counted(quality, "deviations from the protocol"), 1);
  EXPECT_EQ(counted(quality, "checks that failed"), 1);
  EXPECT_EQ(counted(quality, "checks that warned"), 1);
}

}  // namespace
}  // namespace heft
