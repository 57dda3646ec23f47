// Excluded participants and declared plans: only what the protocol says.
#include <gmock/gmock.h>

#include "Figures.h"
#include "MadeUpSessions.h"
#include "analysis/Analysis.h"
#include "analysis/Folds.h"
#include "analysis/dataset/Participants.h"
#include "analysis/dataset/Summary.h"

namespace heft {
namespace {

using namespace made_up;
using testing::HasSubstr;

SessionData with_catches(std::int64_t id, int n_false_alarms) {
  SessionData data = session(id, std::to_string(id));
  add_staircase(data, "15g", 15, 100);
  for (int i = 0; i < 4; ++i) {
    Attempt& attempt = add_comparison(data, "", 15, 0);
    attempt.trial.plan.is_catch = true;
    if (i < n_false_alarms) choose(attempt, false);
  }
  return data;
}

TEST(Exclusion, LeavesNoOneOutUnlessDeclared) {
  SessionData data = with_catches(1, 4);
  data.session.state = SessionState::aborted;
  EXPECT_FALSE(participants_of({&data, 1}).at(0).excluded());
}

TEST(Exclusion, FollowsTheProtocolAndSaysSo) {
  std::vector sessions{with_catches(1, 1), with_catches(2, 4)};
  for (SessionData& data : sessions) data.exclusion.false_alarms = 0.5;
  const Summary summary = summarize({"x.db", sessions}, "");
  EXPECT_EQ(summary.n_participants, 1);
  EXPECT_EQ(figure(summary, "jnd").n, 1);
  ASSERT_EQ(summary.participants.size(), 2);
  EXPECT_THAT(summary.participants[1].excluded_because,
              HasSubstr("false alarms: 4 of 4, the protocol allows 50 %"));
  EXPECT_THAT(summary.notes.at(0), HasSubstr("Excluded from all figures"));
}

TEST(Exclusion, OfUnfinishedSessions) {
  SessionData data = with_catches(1, 0);
  data.exclusion.unfinished = true;
  EXPECT_FALSE(participants_of({&data, 1}).at(0).excluded());
  data.session.state = SessionState::aborted;
  EXPECT_EQ(participants_of({&data, 1}).at(0).excluded_because, "no finished session");
}

TEST(DeclaredPlan, IsThatOfAllSessionsOrNone) {
  std::vector sessions{with_catches(1, 0), with_catches(2, 0)};
  EXPECT_FALSE(declared_plan(sessions).has_value());
  sessions[0].plan.emplace().tested[3] = true;
  EXPECT_FALSE(declared_plan(sessions).has_value());
  sessions[1].plan = sessions[0].plan;
  EXPECT_TRUE(declared_plan(sessions)->declares("E2-H1"));
  const Summary summary = summarize({"x.db", sessions}, "");
  EXPECT_TRUE(summary.hypotheses[3].declared);
  EXPECT_FALSE(summary.hypotheses[0].declared);  // exploratory
}

}  // namespace
}  // namespace heft
