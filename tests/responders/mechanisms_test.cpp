// Mechanisms that are off by default: each does what its row of the table says.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "FakeTrial.h"
#include "psychophysics/ObserverModels.h"
#include "responders/ResponderParameters.h"
#include "responders/decision/Decision.h"
#include "responders/hand/Hand.h"
#include "responders/perception/Perception.h"
#include "tasks/Offers.h"

namespace heft {
namespace {

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double sample_sd(const std::vector<double>& values) {
  double squares = 0;
  for (const double value : values) squares += (value - mean(values)) * (value - mean(values));
  return std::sqrt(squares / static_cast<double>(values.size() - 1));
}

// Largest distance over a trial of one cube.
struct Depth {
  double gap_mm = 0, motion_mm = 0;
};

Depth depth_of(const ResponderParameters& parameters, double mass_g) {
  constexpr double rate_hz = 60;
  const Stage stage = fake::row_of(1, rate_hz);
  fake::World world(stage, "C2", {mass_g});
  Hand hand(parameters, 9, {1, 1, "sorting", stage});
  hand.explore(std::vector<int>{0});
  world.show_cubes();
  Depth depth;
  double start_m = 0;
  for (double t_s = 0; !hand.done(t_s) && t_s < 60; t_s += 1 / rate_hz) {
    world.move_effector(hand.at(t_s));
    const DisplayedFrame frame = world.picture(t_s);
    hand.see(frame);
    const Eigen::Vector3d gap_m = frame.clone->position_m - frame.effector.position_m;
    depth.gap_mm = std::max(depth.gap_mm, 1000 * gap_m.norm());
    if (world.n_pushes()[0] == 0) start_m = frame.cubes[0].position_m.y();
    depth.motion_mm = std::max(depth.motion_mm, 1000 * (frame.cubes[0].position_m.y() - start_m));
  }
  EXPECT_TRUE(hand.done(60));
  return depth;
}

ResponderParameters one_push() {
  ResponderParameters parameters = default_parameters();
  parameters.strokes_per_cube = 1;
  parameters.stroke_variation = 0;
  return parameters;
}

// A hand moves at most 4.5 mm from one picture to the next at 60 Hz.
TEST(AdaptiveDepth, AStrokeEndsWhereTheGapOrTheMotionIsLargeEnough) {
  ResponderParameters parameters = one_push();
  EXPECT_NEAR(depth_of(parameters, 300).gap_mm, 47, 1);
  parameters.stop_gap_m = 0.02;
  EXPECT_THAT(depth_of(parameters, 300).gap_mm, testing::AllOf(testing::Ge(20), testing::Lt(25)));
  EXPECT_NEAR(depth_of(parameters, 100).gap_mm, 15.7, 0.1) << "it never got that large";
  parameters = one_push();
  EXPECT_GT(depth_of(parameters, 100).motion_mm, 40);
  parameters.stop_motion_m = 0.01;
  EXPECT_THAT(depth_of(parameters, 100).motion_mm,
              testing::AllOf(testing::Ge(10), testing::Lt(15)));
}

// The percept of a cube whose hand has moved `hand_mm` and that has moved `cube_mm` itself.
double percept_mm(ResponderParameters parameters, double hand_mm, double cube_mm, int trial = 1) {
  parameters.localization_noise_mm = parameters.length_noise = parameters.integration_s = 0;
  const Stage stage = fake::row_of(1, 15);
  Perception perception(parameters, 3, {trial, 1, "sorting", stage});
  const double tip_m = stage.effector_size_m.x() / 2 + stage.cube_size_m / 2;
  for (int i = 0; i <= 10; ++i) {
    DisplayedFrame frame{
        .t_s = i / 15.0, .tracked = true, .effector = {}, .clone = {}, .cubes = {}};
    Pose cube{stage.slots_m[0], Eigen::Quaterniond::Identity()};
    cube.position_m.y() += cube_mm / 1000 * i / 10;
    Pose clone = resting_pose(stage, 0.005);
    clone.position_m.y() = cube.position_m.y() - tip_m;
    frame.clone = frame.effector = clone;
    frame.effector.position_m.y() += (hand_mm - cube_mm) / 1000 * i / 10;
    frame.cubes = {cube};
    perception.see(frame);
  }
  return perception.percepts_mm()[0];
}

TEST(Cues, TheRatioIsALogarithmAndMotionIsSeenOrNot) {
  ResponderParameters parameters = default_parameters();
  EXPECT_NEAR(percept_mm(parameters, 80, 40), 40, 1e-9);
  parameters.cue = Cue::cd_ratio;
  EXPECT_NEAR(percept_mm(parameters, 80, 40), 90 * std::numbers::ln2, 1e-9);
  EXPECT_NEAR(percept_mm(parameters, 40, 20), 90 * std::numbers::ln2, 1e-9) << "of any length";
  EXPECT_NEAR(percept_mm(parameters, 80, 80), 0, 1e-9);
  EXPECT_NEAR(percept_mm(parameters, 80, 0), 90 * std::log(100), 1e-9) << "at most";
  parameters.cue = Cue::moved;
  parameters.just_visible_mm = 5;
  EXPECT_EQ(percept_mm(parameters, 80, 4), 90);
  EXPECT_EQ(percept_mm(parameters, 80, 6), 0);
  EXPECT_EQ(percept_mm(parameters, 80, 60), 0);
}

// Weights by inverse variances: seen with a standard deviation of 3 mm, felt with one of 4 mm.
TEST(FeltWeight, IsMixedInByItsReliability) {
  ResponderParameters parameters = default_parameters();
  parameters.haptic_mm = 10;
  parameters.haptic_noise_mm = 4;
  const Stage stage = fake::row_of(1, 15);
  std::vector<double> percepts_mm;
  for (int trial = 1; trial <= 4000; ++trial) {
    Perception perception = [&] {
      ResponderParameters noisy = parameters;
      noisy.localization_noise_mm = 3;
      noisy.length_noise = 0;
      return Perception(noisy, 3, {trial, 1, "sorting", stage});
    }();
    percepts_mm.push_back(perception.percepts_mm()[0]);  // nothing seen: 0 mm
  }
  const double felt_share = 9.0 / 25;
  const double sd_mm = felt_share * 4;
  EXPECT_NEAR(mean(percepts_mm), felt_share * 10, 4 * sd_mm / std::sqrt(4000));
  EXPECT_NEAR(sample_sd(percepts_mm), sd_mm, 4 * sd_mm / std::sqrt(2 * 4000));
}

double share_that_differs(const ResponderParameters& parameters, int trial_number,
                          std::optional<bool> last_differed) {
  constexpr int n = 4000;
  int n_different = 0;
  for (std::uint64_t seed = 1; seed <= n; ++seed) {
    const TrialView trial{trial_number, 1, "comparison", {}, {}, last_differed};
    n_different +=
        chosen_slot(Decision(parameters, seed, trial).decide(std::vector{20.0, 16.0}, {})) ? 1 : 0;
  }
  return n_different / static_cast<double>(n);
}

constexpr double tolerance = 0.032;  // four standard deviations of a share of 4000

// The difference of 4 mm has a noise of 2 mm times the square root of 2, against a criterion of 5.
TEST(LastAnswer, MovesTheCriterionTowardsItself) {
  ResponderParameters parameters;
  parameters.criterion_mm = 5;
  parameters.judgment_noise_mm = 2;
  const auto expected = [](double criterion_mm) {
    const double sd_mm = 2 * std::numbers::sqrt2;
    return 1 - normal_cdf((criterion_mm - 4) / sd_mm) + normal_cdf((-criterion_mm - 4) / sd_mm);
  };
  parameters.repetition_mm = 1.5;
  EXPECT_NEAR(share_that_differs(parameters, 5, true), expected(3.5), tolerance);
  EXPECT_NEAR(share_that_differs(parameters, 5, false), expected(6.5), tolerance);
  EXPECT_NEAR(share_that_differs(parameters, 5, std::nullopt), expected(5), tolerance);
}

// Without other noise the criterion of trial t is 5 mm plus an autoregressive sum of t draws.
TEST(CriterionDrift, GrowsFromTrialToTrialAndStaysBounded) {
  ResponderParameters parameters;
  parameters.criterion_mm = 5;
  parameters.criterion_drift_mm = 1;
  parameters.criterion_persistence = 0.9;
  for (const int trial : {1, 2, 10, 100}) {
    const double sd_mm = std::sqrt((1 - std::pow(0.81, trial)) / (1 - 0.81));
    EXPECT_NEAR(share_that_differs(parameters, trial, std::nullopt), normal_cdf(-1 / sd_mm),
                tolerance)
        << "trial " << trial;
  }
}

TEST(CriterionDrift, OfOneParticipantIsTheSameWhereverItsSessionContinues) {
  ResponderParameters parameters;
  parameters.criterion_mm = 5;
  parameters.criterion_drift_mm = 3;
  parameters.criterion_persistence = 0.8;
  const auto answer = [&](int trial) {
    return Decision(parameters, 7, {trial, 1, "comparison", {}})
        .decide(std::vector{20.0, 16.0}, {});
  };
  const Answer alone = answer(40);
  for (int trial = 1; trial < 40; ++trial) answer(trial);
  EXPECT_EQ(answer(40), alone);
}

ResponderParameters drawn(std::uint64_t seed, std::vector<Parameter> given,
                          std::span<const ParameterPart> parts) {
  return participant_parameters({seed, std::move(given), ""}, parts);
}

TEST(Classes, AShareOfTheParticipantsSeesMotionAlone) {
  int n_moved = 0;
  for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
    const auto one = drawn(seed, {{"moved_share", 0.3, {}}}, simulated_parts);
    EXPECT_EQ(one.cue == Cue::moved, one.moved_share == 1);
    n_moved += one.cue == Cue::moved ? 1 : 0;
  }
  EXPECT_NEAR(n_moved, 600, 4 * std::sqrt(2000 * 0.21));
}

// Mean p and variance p (1 - p) / (concentration + 1).
TEST(BetaCoin, DiffersBetweenParticipantsAsABetaDistribution) {
  std::vector<double> p;
  for (std::uint64_t seed = 1; seed <= 4000; ++seed)
    p.push_back(drawn(seed, {{"p", 0.3, {}}, {"concentration", 5.0, {}}}, coin_parts).p);
  const double sd = std::sqrt(0.3 * 0.7 / 6);
  EXPECT_NEAR(mean(p), 0.3, 4 * sd / std::sqrt(4000));
  EXPECT_NEAR(sample_sd(p), sd, 0.05 * sd);
  EXPECT_EQ(drawn(1, {{"p", 0.3, {}}}, coin_parts).p, 0.3);
}

TEST(Mechanisms, AreLoggedWhereTheFileHasThemOnly) {
  const auto logged = drawn_values({1, {}, ""}, simulated_parts);
  for (const char* name : {"stop_gap_m", "haptic_mm", "repetition_mm", "moved_share"})
    EXPECT_FALSE(logged.contains(name)) << name;
  EXPECT_TRUE(logged.contains("criterion_mm"));
  EXPECT_TRUE(
      drawn_values({1, {{"moved_share", 0.5, {}}}, ""}, simulated_parts).contains("moved_share"));
  EXPECT_TRUE(drawn_values({1, {{"stop_gap_m.median", 0.02, {}}}, ""}, simulated_parts)
                  .contains("stop_gap_m"));
}

}  // namespace
}  // namespace heft
