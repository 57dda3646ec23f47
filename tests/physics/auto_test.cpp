// The rule that picks the cheapest simulator that is accurate enough.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "physics/ContactScenes.h"
#include "physics/auto/Choice.h"

namespace heft {
namespace {

std::vector<std::string> names_of(const std::vector<SimulatorPick>& ladder) {
  std::vector<std::string> names;
  for (const SimulatorPick& pick : ladder) names.push_back(pick.simulator);
  return names;
}

Scene with_tolerance(const Tolerance& tolerance) {
  Scene scene = one_cube(0.2);
  scene.tolerance = tolerance;
  return scene;
}

TEST(Auto, TriesAStraightPushBeforeTheGeneralModel) {
  const auto ladder = simulator_ladder(one_cube(0.2), 30);
  EXPECT_THAT(names_of(ladder), testing::ElementsAre("push", "boxes"));
  for (const SimulatorPick& pick : ladder) EXPECT_FALSE(pick.why.empty());
}

TEST(Auto, PromisesTheToleranceForPushesThroughTheMiddle) {
  for (const KnownError& known : known_errors()) EXPECT_LE(known.even, 1) << known.simulator;
  EXPECT_EQ(resolve_auto(one_cube(0.2), 15).why.find("NOT within"), std::string::npos);
}

TEST(Auto, NamesWhatItPromisesNothingFor) {
  using testing::HasSubstr;
  Scene scene = one_cube(0.2);
  EXPECT_THAT(resolve_auto(scene, 15).why, HasSubstr("rigid contacts have no unique result"));
  scene.contact_compliance_m_per_n = 1e-4;
  EXPECT_THAT(resolve_auto(scene, 15).why, AllOf(HasSubstr("stacked cubes, 99.5 % are within"),
                                                 Not(HasSubstr("no unique result"))));
}

TEST(Auto, TakesAtLeastAsManyStepsAsThereArePoses) {
  for (double rate_hz : {15.0, 45.0, 240.0, 5000.0})
    for (const SimulatorPick& pick : simulator_ladder(one_cube(0.2), rate_hz))
      EXPECT_GE(pick.rate_hz, rate_hz);
}

TEST(Auto, TakesMoreStepsForAFasterSpring) {
  const double usual_hz = resolve_auto(one_cube(0.2), 15).rate_hz;
  Scene fast = one_cube(0.2);
  fast.coupling.stiffness_n_per_m *= 16;
  EXPECT_NEAR(resolve_auto(fast, 15).rate_hz, 4 * usual_hz, 1);
  Scene slow = one_cube(0.2);
  slow.coupling.stiffness_n_per_m /= 16;
  EXPECT_EQ(resolve_auto(slow, 15).rate_hz, usual_hz);
}

TEST(Auto, ReportsAMissedTolerance) {
  const auto ladder = simulator_ladder(with_tolerance({1e-9, 1e-9, 1e-9, 1e-9}), 15);
  ASSERT_EQ(ladder.size(), 1u);
  EXPECT_NE(ladder[0].why.find("NOT within the tolerance"), std::string::npos) << ladder[0].why;
  EXPECT_TRUE(simulator_named(ladder[0].simulator).for_sessions);
}

TEST(Auto, LeavesCompliantContactsToBoxes) {
  Scene scene = one_cube(0.2);
  scene.contact_compliance_m_per_n = 1e-4;
  EXPECT_THAT(names_of(simulator_ladder(scene, 60)), testing::ElementsAre("boxes"));
}

TEST(Auto, IsOneSimulatorForASessionWhateverIsInTheScene) {
  Scene three =
      contact_scenes::cubes({cube_of(0.015, 0, -0.08), cube_of(0.2), cube_of(0.8, 0, 0.08)});
  const SimulatorPick pick = resolve_auto(three, 60);
  EXPECT_TRUE(simulator_named(pick.simulator).for_sessions);
  three.cubes[0].mass_kg = 1.5;
  EXPECT_EQ(resolve_auto(three, 60).rate_hz, pick.rate_hz);
}

TEST(Auto, IsASimulatorItself) {
  const auto simulator = make_simulator("auto");
  simulator->reset(one_cube(0.2), Pose{});
  EXPECT_EQ(simulator->state().cubes.size(), 1u);
}

}  // namespace
}  // namespace heft
