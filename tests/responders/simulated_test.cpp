// The simulated participant in whole trials of a world without physics.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "FakeTrial.h"

namespace heft {
namespace {
using fake::make;
using fake::run_trial;
using fake::said;
using fake::TrialSetup;

TrialSetup setup_of(const Task& task, const std::string& condition, int trial_number) {
  TrialSetup setup;
  setup.task = task;
  setup.condition = condition;
  setup.trial_number = trial_number;
  if (task != "sorting") setup.masses_g = {15, 800};
  return setup;
}

// Probability of k or fewer successes in n.
double binomial_at_most(int k, int n, double p) {
  double sum = 0;
  for (int i = 0; i <= k; ++i)
    sum += std::exp(std::lgamma(n + 1) - std::lgamma(i + 1) - std::lgamma(n - i + 1) +
                    i * std::log(p) + (n - i) * std::log1p(-p));
  return sum;
}

struct Counts {
  int answered = 0, correct = 0;
};

Counts sort_many(const TrialSetup& base, int n_participants, int n_trials) {
  Counts counts;
  std::vector<double> masses = base.masses_g;
  for (int participant = 0; participant < n_participants; ++participant) {
    const auto responder = make("simulated", static_cast<std::uint64_t>(participant));
    for (int trial = 1; trial <= n_trials; ++trial) {
      TrialSetup setup = base;
      std::ranges::next_permutation(masses);
      setup.masses_g = masses;
      setup.trial_number = trial;
      const auto result = run_trial(*responder, setup);
      EXPECT_TRUE(result.ended);
      counts.answered += result.answered ? 1 : 0;
      counts.correct += result.correct ? 1 : 0;
    }
  }
  return counts;
}

TEST(Simulated, InC1PermutingTheMassesLeavesEveryAnswerUnchanged) {
  int n_trials = 0;
  std::vector<std::string> first_answers;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const auto responder = make("simulated", seed);
    TrialSetup setup = setup_of("sorting", "C1", 1 + static_cast<int>(seed % 7));
    const auto reference = run_trial(*responder, setup);
    while (std::ranges::next_permutation(setup.masses_g).found) {
      const auto permuted = run_trial(*responder, setup);
      EXPECT_EQ(said(permuted), said(reference)) << "seed " << seed;
      ++n_trials;
    }
    TrialSetup pair = setup_of("comparison", "C1", 3);
    const auto pair_reference = run_trial(*responder, pair);
    std::ranges::reverse(pair.masses_g);
    EXPECT_EQ(said(run_trial(*responder, pair)), said(pair_reference)) << "seed " << seed;
    n_trials += 1;
    first_answers.push_back(said(reference).front());
  }
  EXPECT_EQ(n_trials, 360);
  const std::set<std::string> different(first_answers.begin(), first_answers.end());
  EXPECT_GT(different.size(), 2u) << "answers that are all alike would prove nothing";
}

TEST(Simulated, InC2PermutingTheMassesChangesAnswers) {
  int n_changed = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const auto responder = make("simulated", seed);
    TrialSetup setup = setup_of("sorting", "C2", 1);
    const auto reference = run_trial(*responder, setup);
    std::ranges::reverse(setup.masses_g);
    n_changed += said(run_trial(*responder, setup)) != said(reference) ? 1 : 0;
  }
  EXPECT_GE(n_changed, 18);
}

TEST(Simulated, SortsInC2FarAboveChanceAndAtChanceWithoutTheClone) {
  TrialSetup setup = setup_of("sorting", "C2", 1);
  const Counts seen = sort_many(setup, 30, 6);
  EXPECT_LT(1 - binomial_at_most(seen.correct - 1, 180, 1.0 / 6), 1e-9);

  setup.clone_drawn = false;
  const Counts hidden = sort_many(setup, 60, 6);
  ASSERT_GT(hidden.answered, 100);
  EXPECT_GT(binomial_at_most(hidden.correct, hidden.answered, 1.0 / 6), 0.005);
  EXPECT_GT(1 - binomial_at_most(hidden.correct - 1, hidden.answered, 1.0 / 6), 0.005);
  RecordProperty("correct_of_180_seen", seen.correct);
  RecordProperty("correct_hidden", hidden.correct);
  RecordProperty("answered_hidden", hidden.answered);
}

TEST(Simulated, ComparesRightWhereTheCloneShowsAndSeesNoDifferenceBetweenEquals) {
  int n_right = 0, n_different = 0;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const auto responder = make("simulated", seed);
    TrialSetup setup = setup_of("comparison", "C2", 1);
    setup.masses_g = {15, 400};
    n_right += run_trial(*responder, setup).correct ? 1 : 0;
    setup.masses_g = {15, 15};
    n_different += run_trial(*responder, setup).answered ? 1 : 0;
  }
  EXPECT_GE(n_right, 45);
  EXPECT_LE(n_different, 10);
}

TEST(Simulated, IsAPureFunctionOfSeedTrialAndAttempt) {
  const TrialSetup setup = setup_of("sorting", "C2", 4);
  const auto one = make("simulated", 11), other = make("simulated", 11);
  run_trial(*one, setup_of("comparison", "C2", 3));  // leaves no trace
  const auto first = run_trial(*one, setup), second = run_trial(*other, setup);
  ASSERT_EQ(first.hand.size(), second.hand.size());
  for (std::size_t i = 0; i < first.hand.size(); ++i) {
    EXPECT_EQ(first.hand[i].position_m, second.hand[i].position_m);
    EXPECT_EQ(first.hand[i].orientation.coeffs(), second.hand[i].orientation.coeffs());
  }
  ASSERT_EQ(said(first), said(second));
  for (std::size_t i = 0; i < first.actions.size(); ++i)
    EXPECT_EQ(first.actions[i].t_s, second.actions[i].t_s);

  TrialSetup again = setup;
  again.attempt = 2;
  EXPECT_NE(run_trial(*one, again).end_s, first.end_s);
}

RC_GTEST_PROP(Simulated, EndsEveryTaskByAllowedActionsAlone, ()) {
  TrialSetup setup;
  setup.task = *rc::gen::element<Task>("introduction", "sorting", "comparison");
  setup.condition = *rc::gen::element<std::string>("C1", "C2");
  const auto n = setup.task == "sorting" ? 3u : 2u;
  setup.masses_g = *rc::gen::container<std::vector<double>>(
      n, rc::gen::map(rc::gen::inRange(1, 1500), [](int g) { return static_cast<double>(g); }));
  setup.rate_hz = *rc::gen::element(7.5, 15.0, 30.0, 60.0);
  setup.trial_number = *rc::gen::inRange(1, 100);
  setup.clone_drawn = *rc::gen::arbitrary<bool>();
  setup.paused_from_s = *rc::gen::inRange(0, 25);
  setup.paused_to_s = setup.paused_from_s + *rc::gen::inRange(0, 5);
  const auto responder = make("simulated", *rc::gen::inRange<std::uint64_t>(0, 1000));
  const auto result = run_trial(*responder, setup);
  RC_ASSERT(result.not_allowed == std::vector<std::string>{});
  RC_ASSERT(result.ended);
  RC_ASSERT(result.n_side_hits == 0);
}

TEST(Simulated, TriesTheIntroductionAgainAfterAnotherLook) {
  // With this much noise the first choice is often incorrect.
  const std::vector<Parameter> noise{{"judgment_noise_mm", 50.0, {}}};
  int n_retries = 0;
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const auto responder = make("simulated", seed, noise);
    TrialSetup setup = setup_of("introduction", "C1", 1);
    const auto result = run_trial(*responder, setup);
    ASSERT_TRUE(result.ended);
    ASSERT_LE(result.actions.size(), 2u) << "the other one of two cubes must be right";
    if (result.actions.size() < 2) continue;
    ++n_retries;
    EXPECT_NE(result.actions[0].slot, result.actions[1].slot);
    EXPECT_GT(result.actions[1].t_s - result.actions[0].t_s, 4) << "no look in between";
  }
  EXPECT_GT(n_retries, 5);
}

TEST(Simulated, StopsInsteadOfWaitingForeverWhereNoAnswerIsTaken) {
  for (const ResponderEntry& entry : responders()) {
    if (entry.file == ResponderFile::folder) continue;
    const auto responder = make(entry.name, 5);
    TrialSetup setup = setup_of("comparison", "C2", 1);
    setup.takes_answers = false;
    const auto result = run_trial(*responder, setup);
    EXPECT_EQ(result.actions.size(), 3u) << entry.name;
    EXPECT_LT(result.end_s, 100) << entry.name;
  }
}

}  // namespace
}  // namespace heft
