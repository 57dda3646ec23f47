// The simulated hand: speed and shape of strokes, and paths that avoid other cubes.
#include "responders/hand/Hand.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "FakeTrial.h"

namespace heft {
namespace {
using fake::World;

struct Stroke {
  HandMove move;
  double peak_speed_m_s = 0;
};

double height_m(const Pose& pose) {
  return pose.position_m.z();
}

// Forward movements close over the table.
bool is_stroke(const HandMove& move) {
  return move.to.position_m.y() > move.from.position_m.y() + 0.02 && height_m(move.to) < 0.03 &&
         height_m(move.from) < 0.03;
}

// Explores a whole row and returns the movements of the hand.
std::vector<HandMove> explore(World& world, const Stage& stage, std::uint64_t seed) {
  Hand hand(default_parameters(), seed, {1, 1, "sorting", stage});
  std::vector<int> cubes(stage.slots_m.size());
  std::iota(cubes.begin(), cubes.end(), 0);
  hand.explore(cubes);
  world.show_cubes();
  std::vector<HandMove> moves;
  for (double t_s = 0; !hand.done(t_s) && t_s < 100; t_s += 1 / 240.0) {
    world.move_effector(hand.at(t_s));
    if (std::fmod(t_s + 1e-9, 1 / stage.display_rate_hz) > 1 / 240.0) continue;
    hand.see(world.picture(t_s));
    for (const HandMove& move : hand.path().moves())
      if (moves.empty() || move.start_s > moves.back().start_s) moves.push_back(move);
  }
  EXPECT_TRUE(hand.done(100));
  return moves;
}

TEST(MinimumJerk, StartsAndEndsAtRestAndPeaksAt158OfTheMeanSpeed) {
  const double h = 1e-4;
  const auto speed = [&](double u) {
    return (minimum_jerk(u + h) - minimum_jerk(u - h)) / (2 * h);
  };
  EXPECT_EQ(minimum_jerk(0), 0);
  EXPECT_EQ(minimum_jerk(1), 1);
  EXPECT_NEAR(minimum_jerk(0.5), 0.5, 1e-15);
  EXPECT_NEAR(speed(0.5), 1.875, 1e-6);
  EXPECT_NEAR(speed(h), 0, 1e-5);
  EXPECT_NEAR(speed(1 - h), 0, 1e-5);
  for (double u = 0.01; u < 0.99; u += 0.01) EXPECT_LE(speed(u), 1.875 + 1e-6);
}

TEST(Hand, StrokesHaveHumanLengthAndSpeedAndAMinimumJerkShape) {
  int n_strokes = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Stage stage = fake::row_of(3);
    World world(stage, "C2", {15, 200, 800});
    for (const HandMove& move : explore(world, stage, seed)) {
      if (!is_stroke(move)) continue;
      ++n_strokes;
      const double length_m = (move.to.position_m - move.from.position_m).norm();
      EXPECT_GE(length_m, 0.06);
      EXPECT_LE(length_m, 0.12);
      HandPath path(move.from);
      path.begin_at(move.start_s);
      path.move(move.to, 1.875 * length_m / move.duration_s);
      double peak_m_s = 0;
      const double h = move.duration_s / 2000;
      for (double t = move.start_s; t < move.start_s + move.duration_s; t += h)
        peak_m_s =
            std::max(peak_m_s, (path.at(t + h).position_m - path.at(t).position_m).norm() / h);
      EXPECT_NEAR(peak_m_s, 1.875 * length_m / move.duration_s, 1e-4);
      EXPECT_GE(peak_m_s, 0.15);
      EXPECT_LE(peak_m_s, 0.4);
    }
  }
  EXPECT_GE(n_strokes, 20 * 6);
}

TEST(Hand, PushesEveryCubeFromTheFrontAndNeverTouchesANeighbor) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const Stage stage = fake::row_of(3);
    World world(stage, seed % 2 ? "C1" : "C2", {15, 200, 800});
    explore(world, stage, seed);
    EXPECT_EQ(world.n_side_hits(), 0) << "seed " << seed;
    EXPECT_EQ(world.n_lifts_in_touch(), 0) << "seed " << seed;
    for (int pushes : world.n_pushes()) {
      EXPECT_GE(pushes, 2);
      EXPECT_LE(pushes, 3);
    }
  }
}

TEST(Hand, MovesWithoutJumps) {
  const auto responder = fake::make("simulated", 3);
  fake::TrialSetup setup;
  setup.rate_hz = 60;
  const auto result = fake::run_trial(*responder, setup);
  for (std::size_t i = 1; i < result.hand.size(); ++i) {
    const double speed_m_s =
        60 * (result.hand[i].position_m - result.hand[i - 1].position_m).norm();
    ASSERT_LT(speed_m_s, 1.5) << "picture " << i;
  }
}

TEST(Hand, WaitsAtRestUntilTheCubesAppear) {
  const Stage stage = fake::row_of(2);
  Hand hand(default_parameters(), 1, {1, 1, "comparison", stage});
  const std::vector<int> cubes{0, 1};
  hand.explore(cubes);
  World world(stage, "C2", {15, 200});
  const Pose rest = resting_pose(stage, default_parameters().hover_m);
  for (int i = 0; i < 50; ++i) {
    world.move_effector(hand.at(i / 15.0));
    hand.see(world.picture(i / 15.0));
    ASSERT_EQ(hand.at(i / 15.0).position_m, rest.position_m);
  }
  EXPECT_FALSE(hand.done(50 / 15.0));
  const Eigen::Vector3d tip_m = rest * Eigen::Vector3d(stage.effector_size_m.x() / 2, 0, 0);
  EXPECT_NEAR(tip_m.y(), -stage.cube_size_m / 2 - stage.start_distance_m, 1e-12);
  EXPECT_NEAR(tip_m.x(), 0, 1e-12);
}

TEST(Hand, ApproachesCubesWhereItSeesThem) {
  const Stage stage = fake::row_of(2);
  World world(stage, "C2", {15, 15});
  world.cubes()[0].position_m += Eigen::Vector3d(-0.02, 0.05, 0);
  world.cubes()[1].position_m += Eigen::Vector3d(0.01, -0.03, 0);
  const std::vector<Pose> seen = world.cubes();
  std::vector<bool> reached(2, false);
  for (const HandMove& move : explore(world, stage, 2)) {
    if (!is_stroke(move)) continue;
    const Eigen::Vector3d tip_m = move.from * Eigen::Vector3d(0.045, 0, 0);
    for (std::size_t i = 0; i < 2; ++i)
      if (std::abs(tip_m.x() - seen[i].position_m.x()) < 0.0065 &&
          std::abs(tip_m.y() - (seen[i].position_m.y() - 0.0175 - 0.012)) < 1e-9)
        reached[i] = true;
  }
  EXPECT_TRUE(reached[0]);
  EXPECT_TRUE(reached[1]);
}

TEST(Hand, LeavesACubeThatOthersHemIn) {
  const Stage stage = fake::row_of(2);
  World world(stage, "C2", {15, 15});
  world.cubes()[1].position_m = world.cubes()[0].position_m + Eigen::Vector3d(0, -0.05, 0);
  explore(world, stage, 2);
  EXPECT_EQ(world.n_side_hits(), 0);
  EXPECT_EQ(world.n_pushes()[0], 0) << "the other cube stands in the way";
}

TEST(Hand, GoesHomeWhenTheCubesAreTakenAway) {
  const Stage stage = fake::row_of(2);
  Hand hand(default_parameters(), 1, {1, 1, "comparison", stage});
  const std::vector<int> cubes{0, 1};
  hand.explore(cubes);
  World world(stage, "C2", {800, 800});
  world.show_cubes();
  double t_s = 0;
  for (; t_s < 2; t_s += 1 / 15.0) {
    world.move_effector(hand.at(t_s));
    hand.see(world.picture(t_s));
  }
  ASSERT_GT((hand.at(t_s).position_m - resting_pose(stage, 0.005).position_m).norm(), 0.01);
  DisplayedFrame bare = world.picture(t_s);
  bare.cubes.clear();
  for (; t_s < 6; t_s += 1 / 15.0) {
    bare.t_s = t_s;
    hand.see(bare);
  }
  EXPECT_LT((hand.at(t_s).position_m - resting_pose(stage, 0.005).position_m).norm(), 1e-9);
}

}  // namespace
}  // namespace heft
