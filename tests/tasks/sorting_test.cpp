// Sorting task: end of a trial, labels, and order of techniques and masses.
#include "tasks/Sorting.h"

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include <map>
#include <set>

#include "tasks/Offers.h"

namespace heft {
namespace {
using ::testing::HasSubstr;

TrialPlan plan_of(std::vector<double> masses_g) {
  TrialPlan plan;
  plan.masses_g = std::move(masses_g);
  return plan;
}

Sorting::Trial trial_of(std::vector<double> masses_g) {
  return {{}, plan_of(std::move(masses_g)), 0};
}

TEST(SortingTrial, EndsWithValidateOrDontKnow) {
  const Sorting::Trial trial = trial_of({15, 200, 800});
  EXPECT_FALSE(trial.ends({"label", 1, "lightest"}));
  EXPECT_FALSE(trial.ends({"unlabel", 1}));
  EXPECT_TRUE(trial.ends({"validate"}));
  EXPECT_TRUE(trial.ends({"dont_know"}));
}

TEST(SortingTrial, IsCorrectIfLabelsMatchMasses) {
  for (const bool swapped : {false, true}) {
    Sorting::Trial trial = trial_of({200, 15, 800});
    trial.take({"label", 1, swapped ? "heaviest" : "intermediate"});
    trial.take({"label", 2, "lightest"});
    EXPECT_THAT(*trial.refusal({"validate"}), HasSubstr("not all cubes"));
    trial.take({"label", 3, swapped ? "intermediate" : "heaviest"});
    EXPECT_FALSE(trial.refusal({"validate"}));
    EXPECT_FALSE(trial.result().outcome);
    trial.take({"validate"});
    EXPECT_EQ(trial.result().outcome, swapped ? "incorrect" : "correct");
  }
}

TEST(SortingRun, FrictionGoesWithTheCubeOfItsMass) {
  Sorting::Block block;
  block.name = "sorting";
  block.masses_g = {100, 200, 400};
  block.table_friction = {0.8, 0.4, 0.2};
  EXPECT_TRUE(block.check().empty());
  std::set<std::vector<double>> orders;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const TrialPlan plan = Sorting::Run(block, seed).plan({seed, 1, 1});
    orders.insert(plan.masses_g);
    ASSERT_EQ(plan.table_friction.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_DOUBLE_EQ(plan.masses_g[i] * plan.table_friction[i], 80);
  }
  EXPECT_GT(orders.size(), 3u);
  block.table_friction.pop_back();
  EXPECT_FALSE(block.check().empty());
  block.table_friction.clear();
  EXPECT_TRUE(Sorting::Run(block, 1).plan({1, 1, 1}).table_friction.empty());
}

TEST(SortingTrial, UsedLabelMovesAndCanBeRemoved) {
  Sorting::Trial trial = trial_of({1, 2, 3});
  trial.take({"label", 1, "heaviest"});
  trial.take({"label", 2, "heaviest"});
  ScreenState screen;
  trial.show(screen);
  EXPECT_EQ(labels_on(screen)[0], std::nullopt);
  EXPECT_EQ(labels_on(screen)[1], "heaviest");
  EXPECT_THAT(*trial.refusal({"unlabel", 1}), HasSubstr("no label"));
  EXPECT_FALSE(trial.refusal({"unlabel", 2}));
  trial.take({"unlabel", 2});
  EXPECT_THAT(trial.labels(), ::testing::Each("none"));
  EXPECT_THAT(*trial.refusal({"label", 1, "1"}), HasSubstr("has no label \"1\""));
}

TEST(SortingTrial, DontKnowDiscardsLabels) {
  Sorting::Trial trial = trial_of({1, 2});
  trial.take({"label", 1, "1"});
  EXPECT_THAT(trial.labels(), ::testing::ElementsAre("1", "none"));
  trial.take({"dont_know"});
  EXPECT_EQ(trial.answer(), "dont_know");
  EXPECT_THAT(trial.labels(), ::testing::ElementsAre("none", "none"));
}

TEST(SortingTrial, CanBeValidatedWithAllLabels) {
  Sorting::Trial trial = trial_of({1, 2});
  ScreenState screen;
  screen.can_answer = true;
  trial.take({"label", 1, "1"});
  trial.show(screen);
  EXPECT_FALSE(screen.can_validate);
  trial.take({"label", 2, "2"});
  trial.show(screen);
  EXPECT_TRUE(screen.can_validate);
  screen.can_answer = false;
  trial.show(screen);
  EXPECT_FALSE(screen.can_validate);
}

RC_GTEST_PROP(SortingRun, HasPlannedTechniquesAndRuns, (std::uint64_t seed)) {
  Sorting::Block block;
  block.name = "s";
  block.masses_g = {1, 2};
  const int n1 = *rc::gen::inRange(1, 6), n2 = *rc::gen::inRange(1, 6);
  block.trials = {{"A", n1}, {"B", n2}};
  block.max_run = (std::max(n1, n2) + std::min(n1, n2)) / (std::min(n1, n2) + 1);
  RC_ASSERT(block.check().empty());
  Sorting::Run run(block, seed);
  std::map<std::string, int> counts;
  std::string last;
  int length = 0;
  Changes changes;
  for (int n = 1; !run.finished(); ++n) {
    const std::string technique = run.plan({seed, n, 1}).condition;
    ++counts[technique];
    length = technique == last ? length + 1 : 1;
    RC_ASSERT(length <= block.max_run);
    last = technique;
    run.complete({}, changes);
  }
  RC_ASSERT((counts == std::map<std::string, int>{{"A", n1}, {"B", n2}}));
  --block.max_run;
  RC_ASSERT(block.max_run == 0 || block.check().size() == 1u);
}

TEST(SortingRun, BalancedOrdersComeOncePerRound) {
  Sorting::Block block;
  block.name = "s";
  block.masses_g = {1, 2, 3};
  block.trials = {{"A", 12}};
  block.orders = SortingOrders::balanced;
  Sorting::Run run(block, 5);
  Changes changes;
  std::set<std::vector<double>> round;
  int n_other = 0;
  for (int n = 1; n <= 12; ++n) {
    const std::vector<double> planned = run.plan({5, n, 1}).masses_g;
    EXPECT_TRUE(round.insert(planned).second) << "trial " << n;
    if (n == 6) round.clear();
    n_other += run.plan({5, n, 2}).masses_g != planned;
    run.complete({}, changes);
  }
  EXPECT_GT(n_other, 6);
  EXPECT_TRUE(run.finished());
}

TEST(SortingKeys, AreChecked) {
  Sorting::Block block;
  block.masses_g = {1, 2, 2};
  ASSERT_EQ(block.check().size(), 1u);
  EXPECT_EQ(block.check()[0].keys.front(), "masses_g");
  EXPECT_EQ(block.check()[0].index, 2u);
  block.masses_g = {1};
  EXPECT_THAT(block.check()[0].text(), HasSubstr("expected 2 to 6"));
  block.masses_g = {1, 2};
  block.trials = {{"A", 501}};
  EXPECT_EQ(block.check()[0].keys.front(), "trials");
  block.trials = {{"A", 500}};
  EXPECT_TRUE(block.check().empty());
  block.trials = {{"A", 3}, {"B", 1}};
  block.max_run = 1;
  EXPECT_EQ(block.check()[0].keys.front(), "max_run");
  block.max_run = 2;
  EXPECT_TRUE(block.check().empty());
  block.trials = {{"A", 3}, {"B", -1}};
  EXPECT_TRUE(block.check().empty()) << "which the reader refuses";
}

}  // namespace
}  // namespace heft
