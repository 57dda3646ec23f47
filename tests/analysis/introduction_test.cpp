// The introduction: first tries, and whose count.
#include "analysis/Introduction.h"

#include <gtest/gtest.h>

#include "MadeUpSessions.h"

namespace heft {
namespace {

using namespace made_up;

TEST(Introduction, FirstTryIsExactlyOneSelect) {
  std::vector<SessionData> sessions;
  for (int n_selects : {1, 1, 2, 3}) {
    const auto id = static_cast<std::int64_t>(sessions.size()) + 1;
    sessions.push_back(session(id, std::to_string(id)));
    add_introduction(sessions.back(), n_selects);
  }
  const IntroductionSummary introduction = introduction_of(sessions);
  EXPECT_EQ(introduction.first_try.trials.n_hits, 2);
  EXPECT_EQ(introduction.first_try.trials.n_trials, 4);
  EXPECT_DOUBLE_EQ(*introduction.first_try.percent, 50);
  EXPECT_EQ(introduction.published, &published::introduction_first_try);
}

TEST(Introduction, OnlyTheFirstOfAParticipantCounts) {
  SessionData first = session(1, "a"), again = session(2, "a");
  add_introduction(first, 2);
  add_introduction(again, 1);
  const IntroductionSummary introduction = introduction_of(std::vector{first, again});
  EXPECT_EQ(introduction.first_try.trials.n_trials, 1);
  EXPECT_EQ(introduction.first_try.trials.n_hits, 0);
}

TEST(Introduction, VoidAttemptsDoNotCountAndMayBeAll) {
  SessionData data = session(1, "a");
  add_introduction(data, 1).trial.status = TrialStatus::voided;
  EXPECT_FALSE(introduction_of({&data, 1}).first_try.percent.has_value());
  add_introduction(data, 2);
  EXPECT_EQ(introduction_of({&data, 1}).first_try.percent, 0);
}

TEST(Introduction, OtherMassesHaveNothingPublished) {
  SessionData data = session(1, "a");
  add_introduction(data, 1).cubes = cubes({15, 400});
  EXPECT_EQ(introduction_of({&data, 1}).published, nullptr);
}

TEST(Introduction, AnotherTechniqueHasNothingPublished) {
  SessionData data = session(1, "a");
  data.published_conditions.clear();  // its C2 is no spring of the paper's
  add_introduction(data, 1);
  EXPECT_EQ(introduction_of({&data, 1}).published, nullptr);
}

}  // namespace
}  // namespace heft
