// The introduction: which trials count as correct on the first try.
#include <gtest/gtest.h>

#include "Figures.h"
#include "MadeUpSessions.h"

namespace heft {
namespace {

using namespace made_up;

StudyEstimate first_try(const std::vector<SessionData>& sessions) {
  return figure(sessions, "introduction_first_try");
}

TEST(Introduction, FirstTryIsExactlyOneSelect) {
  std::vector<SessionData> sessions;
  for (int n_selects : {1, 1, 2, 3}) {
    const auto id = static_cast<std::int64_t>(sessions.size()) + 1;
    sessions.push_back(session(id, std::to_string(id)));
    add_introduction(sessions.back(), n_selects);
  }
  const StudyEstimate found = first_try(sessions);
  EXPECT_EQ(found.n_hits, 2);
  EXPECT_EQ(found.n_trials, 4);
  EXPECT_DOUBLE_EQ(*found.value, 50);
  EXPECT_EQ(found.published, &published::introduction_first_try);
}

TEST(Introduction, OnlyTheFirstOfAParticipantCounts) {
  SessionData first = session(1, "a"), again = session(2, "a");
  add_introduction(first, 2);
  add_introduction(again, 1);
  const StudyEstimate found = first_try({first, again});
  EXPECT_EQ(found.n_trials, 1);
  EXPECT_EQ(found.n_hits, 0);
}

TEST(Introduction, VoidAttemptsDoNotCountAndMayBeAll) {
  SessionData data = session(1, "a");
  add_introduction(data, 1).trial.status = TrialStatus::voided;
  EXPECT_FALSE(first_try({data}).value.has_value());
  add_introduction(data, 2);
  EXPECT_EQ(first_try({data}).value, 0);
}

TEST(Introduction, OtherMassesHaveNothingPublished) {
  SessionData data = session(1, "a");
  add_introduction(data, 1).cubes = cubes({15, 400});
  EXPECT_EQ(first_try({data}).published, nullptr);
}

TEST(Introduction, AnotherTechniqueHasNothingPublished) {
  SessionData data = session(1, "a");
  data.published_conditions.clear();  // its C2 is no spring of the paper's
  add_introduction(data, 1);
  EXPECT_EQ(first_try({data}).published, nullptr);
}

}  // namespace
}  // namespace heft
