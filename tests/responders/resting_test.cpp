// Responders that never look, and the table that names them all.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "FakeTrial.h"

namespace heft {
namespace {
using fake::make;
using fake::run_trial;
using fake::said;
using fake::TrialSetup;
using testing::ElementsAre;

TrialSetup setup_of(Task task, std::vector<double> masses_g, int trial_number = 1) {
  TrialSetup setup;
  setup.task = std::move(task);
  setup.masses_g = std::move(masses_g);
  setup.trial_number = trial_number;
  return setup;
}

TEST(Responders, AreFoundByNameAndNearMissesAreNamed) {
  for (const ResponderEntry& entry : responders()) EXPECT_EQ(&responder_named(entry.name), &entry);
  try {
    responder_named("always_yess");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.exit_code(), ExitCode::usage);
    EXPECT_THAT(error.what(), testing::HasSubstr("did you mean \"always_yes\"?"));
  }
}

TEST(AlwaysYes, FindsADifferenceEveryTimeOnEitherSide) {
  const auto responder = make("always_yes", 3);
  std::multiset<int> slots;
  for (int trial = 1; trial <= 200; ++trial) {
    const auto result = run_trial(*responder, setup_of("comparison", {100, 100}, trial));
    ASSERT_EQ(result.actions.size(), 1u);
    ASSERT_EQ(result.actions[0].kind, "select");
    slots.insert(*result.actions[0].slot);
  }
  EXPECT_NEAR(static_cast<double>(slots.count(1)), 100, 29);  // four standard deviations
  EXPECT_EQ(slots.count(1) + slots.count(2), 200u);
}

TEST(AlwaysYes, SortsInEveryOrderAndValidates) {
  const auto responder = make("always_yes", 3);
  std::set<std::vector<std::string>> orders;
  for (int trial = 1; trial <= 100; ++trial) {
    const auto result = run_trial(*responder, setup_of("sorting", {15, 200, 800}, trial));
    EXPECT_TRUE(result.ended && result.answered);
    EXPECT_EQ(result.not_allowed, std::vector<std::string>{});
    auto words = said(result);
    std::ranges::sort(words);
    orders.insert(words);
  }
  EXPECT_EQ(orders.size(), 6u);
}

TEST(AlwaysNo, NeverFindsOneButForTheIntroduction) {
  const auto responder = make("always_no", 3);
  EXPECT_THAT(said(run_trial(*responder, setup_of("comparison", {15, 800}))),
              ElementsAre("no_difference 0 "));
  EXPECT_THAT(said(run_trial(*responder, setup_of("sorting", {15, 200, 800}))),
              ElementsAre("dont_know 0 "));
  EXPECT_THAT(said(run_trial(*responder, setup_of("introduction", {15, 800}))),
              ElementsAre("select 1 ", "select 2 "));
  EXPECT_THAT(said(run_trial(*responder, setup_of("introduction", {800, 15}))),
              ElementsAre("select 1 "));
}

TEST(Coin, FallsOnItsSideWithItsProbability) {
  const auto responder = make("coin", 8, {{"p", 0.3, {}}});
  int n_different = 0;
  for (int trial = 1; trial <= 1000; ++trial)
    n_different +=
        run_trial(*responder, setup_of("comparison", {100, 900}, trial)).answered ? 1 : 0;
  EXPECT_NEAR(n_different, 300, 58);  // four standard deviations
}

TEST(CriterionOnly, DependsOnItsCriterionAndOnNoCube) {
  const auto share_different = [](double criterion_mm, const std::vector<double>& masses_g) {
    const auto responder = make("criterion_only", 2,
                                {{"criterion_mm", criterion_mm, {}},
                                 {"participant_spread", 0.0, {}},
                                 {"lapse_rate", 0.0, {}}});
    int n = 0;
    for (int trial = 1; trial <= 300; ++trial)
      n += run_trial(*responder, setup_of("comparison", masses_g, trial)).answered ? 1 : 0;
    return n;
  };
  EXPECT_EQ(share_different(2, {15, 1500}), share_different(2, {300, 300}));
  EXPECT_GT(share_different(1, {15, 15}), share_different(3, {15, 15}));
  EXPECT_EQ(share_different(100, {15, 1500}), 0);
}

TEST(RestingResponders, LeaveTheCubesAloneAndAnswerSoonAfterSeeingThem) {
  for (std::string_view name :
       {"always_yes", "always_no", "coin", "criterion_only", "start_anchored", "weber"}) {
    const auto responder = make(name, 6);
    for (Task task : {"introduction", "sorting", "comparison"}) {
      std::vector<double> masses{15, 800};
      if (task == "sorting") masses.push_back(200);
      const auto result = run_trial(*responder, setup_of(task, masses));
      EXPECT_TRUE(result.ended) << name;
      EXPECT_EQ(result.not_allowed, std::vector<std::string>{}) << name;
      for (int pushes : result.n_pushes) EXPECT_EQ(pushes, 0) << name;
      for (const Pose& pose : result.hand) ASSERT_EQ(pose.position_m, result.hand[0].position_m);
      // The cubes appear with the third picture, 2/15 s into the trial.
      EXPECT_GE(result.actions.front().t_s, 1 + 2 / 15.0) << name;
      EXPECT_LE(result.actions.front().t_s, 2 + 3 / 15.0) << name;
    }
  }
}

}  // namespace
}  // namespace heft
