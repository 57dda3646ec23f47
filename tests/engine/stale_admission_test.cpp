// An event that is applied after others that followed its admission is checked again.
#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include "base/Random.h"
#include "engine/Engine.h"
#include "engine/Plans.h"

namespace heft {
namespace {

using ::testing::HasSubstr;

SessionPlan comparing() {
  return {{testing::small_plan().blocks.back()}};
}

class StaleAdmission : public ::testing::Test {
 protected:
  StaleAdmission() {
    apply(TrialStarted{});
    apply(CubesShown{});
  }
  void apply(EventPayload what) { engine.apply({++t_s, std::move(what)}); }
  AdmittedEvent answer() const { return *engine.admit({t_s + 100, chosen}).admitted; }
  // A refused event does not change the state.
  void expect_refusal(const AdmittedEvent& stale, const std::string& why) {
    const int n_events = engine.n_events();
    const double last_s = engine.last_s();
    const Applied applied = engine.apply(stale);
    EXPECT_FALSE(applied.changes);
    EXPECT_THAT(applied.refusal, HasSubstr(why));
    EXPECT_EQ(engine.n_events(), n_events);
    EXPECT_EQ(engine.last_s(), last_s);
  }

  const Action chosen{"select", 1};
  Engine engine{testing::shared(comparing()), 7};
  double t_s = 0;
};

TEST_F(StaleAdmission, OfAnswerIsRefusedAfterPause) {
  const AdmittedEvent stale = answer();
  apply(SessionPaused{"database locked"});
  expect_refusal(stale, "paused");
  apply(SessionContinued{});
  EXPECT_TRUE(engine.apply(stale).changes) << "it can come again";
}

TEST_F(StaleAdmission, OfAnswerIsRefusedAfterVeto) {
  const AdmittedEvent stale = answer();
  apply(TrialVoided{"veto: disturbance"});
  expect_refusal(stale, "no trial is running");
  apply(TrialStarted{});
  expect_refusal(stale, "not shown yet");
}

TEST_F(StaleAdmission, OfAnswerIsRefusedAfterAnotherAnswer) {
  const AdmittedEvent first = answer(), second = answer();
  EXPECT_TRUE(engine.apply(first).changes);
  expect_refusal(second, "no trial is running");
}

TEST_F(StaleAdmission, IsRefusedAfterLaterEvent) {
  const AdmittedEvent stale = answer();
  t_s += 200;
  apply(Note{"the phone rang"});
  expect_refusal(stale, "before the last event");
}

TEST_F(StaleAdmission, IsValidAfterEndOfContacts) {
  apply(CubeTouch{1});
  const AdmittedEvent stale = answer();
  apply(CubeTouch{1, 0.5});
  EXPECT_EQ(engine.apply(stale).changes->trial->chosen_slot, 1);
}

// After any other events, applying an admitted event equals applying the event itself.
RC_GTEST_PROP(StaleAdmissionProperty, EqualsNewAdmission, (std::uint64_t seed)) {
  RandomStream stream(seed, "stale");
  Engine engine(testing::shared(comparing()), seed), plain(testing::shared(comparing()), seed);
  const std::vector<EventPayload> all{TrialStarted{},       CubesShown{},       Action{"select", 1},
                                      SessionPaused{"why"}, SessionContinued{}, TrialVoided{"why"},
                                      AnswerVetoed{"why"},  Note{"why"},        CubeTouch{1}};
  std::vector<AdmittedEvent> held;
  for (int i = 0; i < 200; ++i) {
    const Event event{static_cast<double>(i), all[stream.below(all.size())]};
    if (const Admission admission = engine.admit(event); admission.admitted)
      held.push_back(*admission.admitted);
    if (held.empty() || stream.coin(0.5)) continue;
    const AdmittedEvent chosen = held[stream.below(held.size())];
    const std::string refusal = plain.admit(chosen.event()).refusal;
    const Applied applied = engine.apply(chosen);
    RC_ASSERT(applied.refusal == refusal);
    RC_ASSERT(applied.changes.has_value() == refusal.empty());
    if (applied.changes) plain.apply(chosen.event());
    RC_ASSERT(engine.n_events() == plain.n_events());
    RC_ASSERT(engine.n_completed() == plain.n_completed());
  }
}

}  // namespace
}  // namespace heft
