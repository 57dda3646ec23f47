// Calls of Drive to a simulator, and results with real simulators.
#include "physics/Drive.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "base/Pose.h"
#include "physics/Pushes.h"
#include "physics/scene/Oracles.h"

namespace heft {
namespace {

// Records calls; its clone is at the target.
struct Calls {
  std::vector<std::string> names;
  std::vector<Pose> targets;
  std::vector<double> steps_s;
  Velocity teleport_velocity;
  bool solid = true;
};

class FakeSimulator : public DecouplingSimulator {
 public:
  explicit FakeSimulator(Calls& calls) : calls_(calls) {}
  void reset(const Scene& scene, const Pose& target) override {
    calls_.names.push_back("reset");
    state_.cubes.clear();
    for (const Cube& cube : scene.cubes)
      state_.cubes.push_back({upright_pose(cube.position_m, 0), {}});
    state_.clone.pose = target;
  }
  void step(const Pose& target, double h_s) override {
    calls_.targets.push_back(target);
    calls_.steps_s.push_back(h_s);
    state_.clone.pose = target;
  }
  void teleport_clone(const Pose& target, const Velocity& velocity) override {
    calls_.names.push_back("teleport");
    calls_.teleport_velocity = velocity;
    state_.clone.pose = target;
  }
  void set_clone_solid(bool solid) override { calls_.solid = solid; }
  void place_cube(int cube, const Pose& pose) override {
    state_.cubes[static_cast<std::size_t>(cube)] = {pose, {}};
  }
  WorldState state() const override { return state_; }

 private:
  Calls& calls_;
  WorldState state_;
};

TargetSample seen(double t_s, double x_m, double z_m = 0.021) {
  TargetSample sample;
  sample.t_capture_s = t_s;
  sample.pose = upright_pose({x_m, 0, z_m}, 0);
  return sample;
}

TargetSample lost(double t_s) {
  TargetSample sample;
  sample.t_capture_s = t_s;
  sample.tracked = false;
  sample.pose.position_m.setConstant(std::numeric_limits<double>::quiet_NaN());  // not to be used
  return sample;
}

class DriveSteps : public testing::Test {
 protected:
  Calls calls;
  Scene scene = one_cube(0.2);
  Drive drive{std::make_unique<FakeSimulator>(calls), scene, 240};
};

TEST_F(DriveSteps, AFifteenthOfASecondIsSixteenEqualStepsAlongThePath) {
  for (int picture = 0; picture < 40; ++picture) {
    calls.targets.clear();
    calls.steps_s.clear();
    drive.advance(seen(picture / 15.0, -0.3 + 0.001 * picture));
    if (picture == 0) continue;
    ASSERT_EQ(calls.targets.size(), 16u) << picture;
    for (double h_s : calls.steps_s) EXPECT_NEAR(h_s, 1.0 / 240, 1e-12);
    EXPECT_NEAR(calls.targets[3].position_m.x(), -0.3 + 0.001 * (picture - 0.75), 1e-12);
    EXPECT_EQ(calls.targets[15].position_m.x(), -0.3 + 0.001 * picture);
  }
  EXPECT_THAT(calls.names, testing::ElementsAre("reset"));
}

TEST_F(DriveSteps, AnyPauseIsCutIntoStepsNoLongerThanTheRateAllows) {
  drive.advance(seen(0, -0.2));
  drive.advance(seen(0.0101, -0.2));
  EXPECT_EQ(calls.steps_s.size(), 3u);
  EXPECT_NEAR(calls.steps_s[0], 0.0101 / 3, 1e-15);
  drive.advance(seen(0.0102, -0.2));
  EXPECT_EQ(calls.steps_s.size(), 4u);
}

TEST_F(DriveSteps, AGapOfUpToAQuarterSecondIsAPathALongerOneAJump) {
  drive.advance(seen(0, -0.2));
  drive.advance(seen(0.25, -0.19));
  EXPECT_THAT(calls.names, testing::ElementsAre("reset"));
  TargetSample late = seen(0.51, -0.15);
  late.velocity.linear_m_s = {0.3, 0, 0};
  drive.advance(late);
  EXPECT_THAT(calls.names, testing::ElementsAre("reset", "teleport"));
  EXPECT_EQ(calls.teleport_velocity.linear_m_s.x(), 0.3);
  EXPECT_EQ(calls.targets.back().position_m.x(), -0.19);  // the world kept moving
  EXPECT_EQ(calls.targets.size(), 60u + 63u);
}

TEST_F(DriveSteps, AJumpTeleports) {
  drive.advance(seen(0, -0.2));
  TargetSample jump = seen(0.05, -0.15);
  jump.jump = true;
  drive.advance(jump);
  EXPECT_THAT(calls.names, testing::ElementsAre("reset", "teleport"));
  EXPECT_TRUE(calls.solid);
}

TEST_F(DriveSteps, OutOfViewHidesTheCloneAndTouchesNothing) {
  drive.advance(seen(0, -0.2));
  EXPECT_FALSE(drive.advance(lost(0.05)).clone_present);
  EXPECT_FALSE(calls.solid);
  EXPECT_FALSE(drive.advance(lost(3)).clone_present);
  EXPECT_TRUE(drive.advance(seen(3.05, -0.1)).clone_present);
  EXPECT_THAT(calls.names, testing::ElementsAre("reset", "teleport"));
  EXPECT_TRUE(calls.solid);
}

TEST_F(DriveSteps, AfterReturningContactIsOnOnlyOnceTheCloneIsClear) {
  drive.advance(seen(0, -0.2));
  drive.advance(lost(0.05));
  drive.advance(seen(0.10, 0));  // inside the cube
  EXPECT_FALSE(calls.solid);
  drive.advance(seen(0.15, -0.0624));  // 0.1 mm into it
  EXPECT_FALSE(calls.solid);
  drive.advance(seen(0.20, -0.0635));
  EXPECT_TRUE(calls.solid);
}

TEST_F(DriveSteps, MayStartWithoutAnEffector) {
  EXPECT_FALSE(drive.advance(lost(0)).clone_present);
  EXPECT_FALSE(calls.solid);
  EXPECT_TRUE(drive.advance(seen(0.05, -0.2)).clone_present);
  EXPECT_THAT(calls.names, testing::ElementsAre("reset", "teleport"));
  EXPECT_EQ(drive.state().clone.pose.position_m.x(), -0.2);
}

TEST_F(DriveSteps, RefusesTimeThatDoesNotAdvanceAndUnusableSamples) {
  drive.advance(seen(1, -0.2));
  EXPECT_THROW(drive.advance(seen(1, -0.2)), std::exception);
  EXPECT_THROW(drive.advance(seen(0.9, -0.2)), std::exception);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(drive.advance(seen(nan, -0.2)), std::exception);
  EXPECT_THROW(drive.advance(seen(1.1, nan)), std::exception);
  TargetSample bent = seen(1.1, -0.2);
  bent.pose.orientation.coeffs() *= 2;
  EXPECT_THROW(drive.advance(bent), std::exception);
  drive.advance(seen(1.1, -0.2));  // and continues afterwards
}

TEST_F(DriveSteps, ReturnsACubeAndKeepsTheCloneOffUntilItIsClearOfIt) {
  drive.advance(seen(0, -0.2));
  drive.advance(seen(0.05, 0));
  drive.return_cube(0);
  EXPECT_FALSE(calls.solid);
  EXPECT_EQ(drive.state().cubes[0].pose.position_m.x(), 0);
  EXPECT_THROW(drive.return_cube(1), std::exception);
  EXPECT_THROW(drive.return_cube(-1), std::exception);
}

class DriveTargets : public testing::Test {
 protected:
  // x of every target for these samples, 0.1 s apart, two steps each.
  std::vector<double> targets(const DriveInput& input,
                              const std::vector<TargetSample>& seen_samples) {
    Calls calls;
    Drive drive(std::make_unique<FakeSimulator>(calls), one_cube(0.2), 20, input);
    for (const TargetSample& sample : seen_samples) drive.advance(sample);
    std::vector<double> x_m;
    for (const Pose& target : calls.targets) x_m.push_back(target.position_m.x());
    return x_m;
  }
  static auto near(const std::vector<double>& values) {
    return testing::Pointwise(testing::DoubleNear(1e-12), values);
  }
  const std::vector<TargetSample> samples{seen(0, -0.50), seen(0.1, -0.48), seen(0.2, -0.44)};
};

TEST_F(DriveTargets, PathGoesToTheNewPose) {
  EXPECT_THAT(targets({InputMode::path}, samples), near({-0.49, -0.48, -0.46, -0.44}));
}

// The middle of the cubic is the mean of both poses plus (v0 - v1) times an eighth of 0.1 s.
TEST_F(DriveTargets, SmoothBendsAsTheVelocitiesSayAndIsStraightWithoutAny) {
  EXPECT_THAT(targets({InputMode::smooth}, samples), targets({InputMode::path}, samples));
  auto moving = samples;
  moving[0].velocity.linear_m_s.x() = 0.1;
  moving[1].velocity.linear_m_s.x() = 0.3;
  moving[2].velocity.linear_m_s.x() = 0.5;
  EXPECT_THAT(targets({InputMode::smooth}, moving), near({-0.4925, -0.48, -0.4625, -0.44}));
  moving[1].jump = true;
  EXPECT_THAT(targets({InputMode::smooth}, moving), near({-0.50, -0.50, -0.4625, -0.44}));
}

// A hand of 1 Hz and 10 cm, sampled at 15 Hz. The linear path is off by more than 0.1 mm.
TEST(Smooth, FollowsAHandInFreeAir) {
  const double w = 2 * M_PI, a_m = 0.05, turn_rad = 0.3;
  const auto hand = [&](double t_s) {
    TargetSample sample;
    sample.t_capture_s = t_s;
    sample.pose = upright_pose({a_m * std::sin(w * t_s), 0, 0.2}, turn_rad * std::cos(w * t_s));
    sample.velocity = {{a_m * w * std::cos(w * t_s), 0, 0},
                       {0, 0, -turn_rad * w * std::sin(w * t_s)}};
    return sample;
  };
  const auto worst_m = [&](const char* name, InputMode mode) {
    Drive truth(make_simulator(name), Scene{}, 15360),
        seen(make_simulator(name), Scene{}, 240, {mode});
    double worst = 0;
    for (int i = 0; i <= 30 * 64; ++i) {
      const Pose should = truth.advance(hand(i / 960.0)).clone.pose;
      if (i % 64) continue;
      const Pose is = seen.advance(hand(i / 960.0)).clone.pose;
      if (i >= 15 * 64) worst = std::max(worst, (is.position_m - should.position_m).norm());
    }
    return worst;
  };
  for (const char* name : {"boxes", "bullet-lx"}) {
    EXPECT_LT(worst_m(name, InputMode::smooth), 0.02e-3) << name;
    EXPECT_GT(worst_m(name, InputMode::path), 0.1e-3) << name;
  }
}

TEST_F(DriveTargets, HoldStaysAtTheLastPose) {
  EXPECT_THAT(targets({InputMode::hold}, samples), near({-0.50, -0.50, -0.48, -0.48}));
}

TEST_F(DriveTargets, ExtrapolateContinuesTheLastTwo) {
  EXPECT_THAT(targets({InputMode::extrapolate}, samples), near({-0.50, -0.50, -0.47, -0.46}));
}

TEST_F(DriveTargets, ExtrapolateContinuesRotation) {
  Calls calls;
  Drive drive(std::make_unique<FakeSimulator>(calls), one_cube(0.2), 20, {InputMode::extrapolate});
  for (int i = 0; i < 3; ++i) {
    TargetSample sample = seen(0.1 * i, -0.5);
    sample.pose = upright_pose(sample.pose.position_m, 0.2 * i);
    drive.advance(sample);
  }
  EXPECT_NEAR(rotation_vector(calls.targets.back().orientation).z(), 0.4, 1e-12);
}

TEST_F(DriveTargets, ExtrapolateForgetsTheCourseAtAJump) {
  auto jumped = samples;
  jumped[1].jump = true;
  EXPECT_THAT(targets({InputMode::extrapolate}, jumped), near({-0.50, -0.50, -0.48, -0.48}));
}

// Half a second ahead of speeds .1, .2 and .4 m/s: at -.45, -.38 and -.24.
TEST_F(DriveTargets, PredictsEverySampleAlongItsVelocity) {
  auto moving = samples;
  for (std::size_t i = 0; i < moving.size(); ++i)
    moving[i].velocity.linear_m_s.x() = 0.1 * (1 << i);
  EXPECT_THAT(targets({InputMode::path, 0.5}, moving), near({-0.415, -0.38, -0.31, -0.24}));
  EXPECT_THAT(targets({InputMode::hold, 0.5}, moving), near({-0.45, -0.45, -0.38, -0.38}));
  EXPECT_THAT(targets({InputMode::extrapolate, 0.5}, moving), near({-0.45, -0.45, -0.345, -0.31}));
  EXPECT_THAT(targets({InputMode::path, 0}, moving), targets({InputMode::path}, samples));
}

TEST_F(DriveTargets, ACloneThatJumpsComesBackWhereItIsPredicted) {
  Calls calls;
  Drive drive(std::make_unique<FakeSimulator>(calls), one_cube(0.2), 20, {InputMode::path, 0.1});
  TargetSample sample = seen(0, -0.5);
  sample.velocity.linear_m_s.x() = 0.2;
  EXPECT_NEAR(drive.advance(sample).clone.pose.position_m.x(), -0.48, 1e-12);
  sample.t_capture_s = 0.1;
  sample.jump = true;
  sample.pose.position_m.x() = -0.3;
  EXPECT_NEAR(drive.advance(sample).clone.pose.position_m.x(), -0.28, 1e-12);
}

TEST(Predicted, ContinuesTranslationAndRotation) {
  TargetSample sample = seen(0, -0.5);
  sample.pose = upright_pose({-0.5, 0.1, 0.02}, 0.3);
  sample.velocity = {{0.2, -0.4, 0}, {0, 0, 2}};
  const Pose ahead = predicted(sample, 0.05);
  EXPECT_LT((ahead.position_m - Eigen::Vector3d(-0.49, 0.08, 0.02)).norm(), 1e-12);
  EXPECT_NEAR(rotation_vector(ahead.orientation).z(), 0.4, 1e-12);
}

TEST(Drive, RefusesAPredictionOfThePast) {
  Calls calls;
  for (double predict_s : {-0.05, std::numeric_limits<double>::infinity()})
    EXPECT_THROW(
        Drive(std::make_unique<FakeSimulator>(calls), Scene{}, 240, {InputMode::path, predict_s}),
        std::exception);
}

TEST(Drive, RefusesARateThatIsNoRate) {
  Calls calls;
  for (double rate_hz : {0.0, -240.0, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(Drive(std::make_unique<FakeSimulator>(calls), Scene{}, rate_hz), std::exception);
}

Drive drive_of(const Scene& scene) {
  return Drive(make_simulator("bullet"), scene, 240);
}

TEST(DriveInAWorld, PicturesAtFifteenHertzGiveTheSteadyLag) {
  Drive drive = drive_of(one_cube(0.2));
  const Stroke stroke{.speed_m_s = 0.05, .length_m = 0.15};
  double lag_m = 0;
  for (int picture = 0; picture <= 45; ++picture) {
    TargetSample sample;
    sample.t_capture_s = picture / 15.0;
    sample.pose = stroke.at(sample.t_capture_s);
    const WorldState& state = drive.advance(sample);
    lag_m = sample.pose.position_m.x() - state.clone.pose.position_m.x();
  }
  EXPECT_NEAR(lag_m, steady_lag_m(0.8, 0.2, 50), 0.3e-3);
}

// The effector disappears after a push: the cube slides to rest, and a hand that returns inside it
// does not throw it.
TEST(DriveInAWorld, CubesKeepMovingWhileTheEffectorIsAway) {
  Scene scene = one_cube(0.2);
  scene.coupling.decoupled = false;
  Drive drive = drive_of(scene);
  const Stroke stroke{.speed_m_s = 0.5, .length_m = 0.1};
  int picture = 0;
  for (; picture <= 6; ++picture) {
    TargetSample sample;
    sample.t_capture_s = picture / 30.0;
    sample.pose = stroke.at(sample.t_capture_s);
    drive.advance(sample);
  }
  const double speed_m_s = drive.state().cubes[0].velocity.linear_m_s.x();
  EXPECT_NEAR(speed_m_s, 0.5, 0.01);
  const double left_at_m = drive.state().cubes[0].pose.position_m.x();
  const WorldState away = drive.advance(lost(picture / 30.0 + 1));
  const double slide_m = speed_m_s * speed_m_s / (2 * 0.8 * 9.81);
  EXPECT_NEAR(away.cubes[0].pose.position_m.x(), left_at_m + slide_m, 1.5e-3);
  EXPECT_EQ(away.cubes[0].velocity.linear_m_s.norm(), 0);
  EXPECT_TRUE(away.contacts.empty());
  double t_s = picture / 30.0 + 1;
  for (int i = 0; i < 30; ++i)
    drive.advance(seen(t_s += 1 / 30.0, away.cubes[0].pose.position_m.x() + 0.001 * i));
  EXPECT_TRUE(drive.state().contacts.empty());
  EXPECT_EQ(drive.state().cubes[0].pose.position_m, away.cubes[0].pose.position_m);
}

TEST(DriveInAWorld, AHandThatJumpsAcrossTheTableMovesNoCube) {
  Drive drive = drive_of(one_cube(0.015));
  drive.advance(seen(0, -0.2));
  TargetSample jump = seen(1 / 15.0, 0.2);
  jump.jump = true;
  drive.advance(jump);
  drive.advance(seen(2 / 15.0, 0.2));
  EXPECT_NEAR(drive.state().cubes[0].pose.position_m.x(), 0, 1e-6);
  EXPECT_NEAR(drive.state().clone.pose.position_m.x(), 0.2, 1e-12);
}

TEST(DriveInAWorld, AReturnedCubeIsBackAndStaysThere) {
  Drive drive = drive_of(one_cube(0.05));
  const Stroke stroke;
  for (int picture = 0; picture <= 15; ++picture) {
    TargetSample sample;
    sample.t_capture_s = picture / 15.0;
    sample.pose = stroke.at(sample.t_capture_s);
    drive.advance(sample);
  }
  EXPECT_GT(drive.state().cubes[0].pose.position_m.x(), 0.05);
  drive.return_cube(0);
  for (int picture = 16; picture <= 30; ++picture) drive.advance(seen(picture / 15.0, 0.0355));
  EXPECT_NEAR(drive.state().cubes[0].pose.position_m.x(), 0, 0.01e-3);
}

}  // namespace
}  // namespace heft
