// Null models that know the plan, and the observer who uses all that is displayed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "FakeTrial.h"
#include "psychophysics/ObserverModels.h"
#include "psychophysics/ProcedureKinds.h"
#include "responders/ResponderParameters.h"
#include "responders/decision/KnownPlan.h"
#include "tasks/Comparison.h"
#include "tasks/blocks/SessionPlan.h"

namespace heft {
namespace {
using fake::make;
using fake::run_trial;
using fake::said;
using testing::ElementsAre;

constexpr double tolerance = 0.063;  // four standard deviations of a share of 1000

TrialView comparison(int trial_number, std::vector<double> masses_g,
                     std::optional<double> start_g = {}) {
  TrialView view{trial_number, 1, "comparison", fake::row_of(2, 15)};
  const double level_g = masses_g[1] - masses_g[0];
  view.truth = TrialTruth{std::move(masses_g), level_g, start_g};
  return view;
}

/// Shares of "different" answers, and of the second cube among them.
struct Shares {
  double different = 0, second = 0;
};

Shares shares_of(const Responder& responder, const std::vector<double>& masses_g,
                 std::optional<double> start_g = {}) {
  constexpr int n = 1000;
  int n_different = 0, n_second = 0;
  for (int trial = 1; trial <= n; ++trial) {
    const auto slot = chosen_slot(*responder.judge(comparison(trial, masses_g, start_g), {}));
    n_different += slot ? 1 : 0;
    n_second += slot == 2 ? 1 : 0;
  }
  return {n_different / double{n}, n_second / std::max(1.0, double(n_different))};
}

std::unique_ptr<Responder> alike(std::string_view name, std::vector<Parameter> parameters) {
  parameters.push_back({"participant_spread", 0.0, {}});
  return make(name, 4, std::move(parameters));
}

// The share of "different" is Phi((level / start - fraction) / noise), independent of the masses;
// either cube is chosen.
TEST(StartAnchored, AnswersByTheShareOfTheStartThatIsLeft) {
  const auto model =
      alike("start_anchored", {{"anchor_fraction", 0.4, {}}, {"anchor_noise", 0.2, {}}});
  for (const double reference_g : {15.0, 800.0})
    for (const double share : {0.1, 0.4, 0.7}) {
      const Shares found = shares_of(*model, {reference_g, reference_g + 600 * share}, 600.0);
      EXPECT_NEAR(found.different, normal_cdf((share - 0.4) / 0.2), tolerance);
      if (share < 0.3) continue;
      EXPECT_NEAR(found.second, 0.5, 1.5 * tolerance) << "it knows no mass";
    }
}

TEST(StartAnchored, IsACoinWhereNothingStarted) {
  const auto model = alike("start_anchored", {{"p", 0.3, {}}});
  EXPECT_NEAR(shares_of(*model, {15, 1500}).different, 0.3, tolerance);
  fake::TrialSetup sorting;
  int n_sorted = 0;
  for (sorting.trial_number = 1; sorting.trial_number <= 400; ++sorting.trial_number)
    n_sorted += run_trial(*model, sorting).answered ? 1 : 0;
  EXPECT_NEAR(n_sorted, 120, 4 * std::sqrt(400 * 0.21));
}

// Two judged logarithms differ by ln(ratio) with a noise of 0.1 times the square root of 2.
TEST(Weber, ComparesMassesByTheirRatioAlone) {
  const auto model = alike("weber", {{"weber_fraction", 0.3, {}}, {"weber_noise", 0.1, {}}});
  const double sd = 0.1 * std::numbers::sqrt2, criterion = std::log(1.3);
  for (const double reference_g : {15.0, 800.0})
    for (const double ratio : {1.0, 1.3, 1.5}) {
      const double up = normal_cdf((std::log(ratio) - criterion) / sd);
      const double down = normal_cdf((-std::log(ratio) - criterion) / sd);
      const Shares found = shares_of(*model, {reference_g, ratio * reference_g});
      EXPECT_NEAR(found.different, up + down, tolerance) << reference_g << " x " << ratio;
      EXPECT_GT(found.second, ratio > 1.2 ? 0.95 : 0);
    }
}

TEST(Weber, SortsInEveryTechniqueAlike) {
  const auto model = alike("weber", {});
  fake::TrialSetup setup;
  const auto by_spring = said(run_trial(*model, setup));
  setup.condition = "C1";
  EXPECT_EQ(said(run_trial(*model, setup)), by_spring);
  EXPECT_THAT(said(run_trial(*model, {.task = "introduction", .masses_g = {15, 800}})),
              ElementsAre("select 2 "));
}

TEST(KnownPlan, IsGivenOnlyToRespondersThatDeclareIt) {
  for (const ResponderEntry& entry : responders()) {
    if (entry.file == ResponderFile::folder) continue;
    const bool knows = entry.name == "start_anchored" || entry.name == "weber";
    EXPECT_EQ(entry.make({})->knows_plan(), knows) << entry.name;
    EXPECT_FALSE(knows && entry.touches_cubes) << entry.name;
  }
}

TEST(KnownPlan, HasTheFirstLevelOfTheTrialsOwnProcedure) {
  Comparison::Block block;
  block.name = "comparison";
  for (const auto& [reference_g, start_g] : {std::pair(15.0, 175.0), std::pair(200.0, 600.0)}) {
    UpDownConfig config;
    config.start = start_g;
    config.step = 50;
    block.staircases.push_back({reference_g, Procedure(fmt::format("{}g", reference_g), config)});
  }
  Sorting::Block sorting;
  sorting.name = "sorting";
  const SessionPlan session{{TaskBlock(sorting), TaskBlock(block)}};
  TrialPlan plan;
  plan.block = "comparison";
  plan.masses_g = {200, 350};
  plan.level_g = 150;
  plan.reference_g = 200;
  plan.staircase = "200g";
  EXPECT_EQ(truth_of(session, plan).start_g, 600);
  EXPECT_EQ(truth_of(session, plan).level_g, 150);
  plan.staircase.clear();  // a catch trial
  plan.reference_g = 15;
  EXPECT_EQ(truth_of(session, plan).start_g, 175);
  plan.block = "sorting";
  EXPECT_EQ(truth_of(session, plan).start_g, std::nullopt);
  EXPECT_EQ(truth_of(session, plan).masses_g, plan.masses_g);
}

TEST(Ideal, SeesSmallDifferencesAndNoneThatIsNotDisplayed) {
  const auto ideal = make("ideal", 5);
  int n_right = 0, n_blind = 0;
  fake::TrialSetup setup{.task = "comparison", .masses_g = {200, 230}};
  for (setup.trial_number = 1; setup.trial_number <= 20; ++setup.trial_number) {
    setup.condition = "C2";
    const auto shown = run_trial(*ideal, setup);
    n_right += shown.answered && shown.correct ? 1 : 0;
    setup.condition = "C1";
    n_blind += run_trial(*ideal, setup).answered ? 1 : 0;
  }
  EXPECT_EQ(n_right, 20);
  EXPECT_EQ(n_blind, 0);
}

}  // namespace
}  // namespace heft
