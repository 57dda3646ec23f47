// The simulated eye: percepts of displayed frames.
#include "responders/perception/Perception.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "FakeTrial.h"
#include "base/PoseTypes.h"
#include "responders/hand/Hand.h"
#include "responders/perception/SeenGeometry.h"

namespace heft {
namespace {
using fake::World;
using testing::ElementsAre;

ResponderParameters noiseless() {
  ResponderParameters parameters = default_parameters();
  parameters.localization_noise_mm = parameters.length_noise = 0;
  return parameters;
}

std::vector<double> percepts_mm(const ResponderParameters& parameters, const Stage& stage,
                                World world) {
  const TrialView trial{1, 1, "sorting", stage};
  Hand hand(parameters, 9, trial);
  Perception perception(parameters, 9, trial);
  std::vector<int> cubes(stage.slots_m.size());
  std::iota(cubes.begin(), cubes.end(), 0);
  hand.explore(cubes);
  world.show_cubes();
  for (int i = 0; i < 2000; ++i) {
    const double t_s = i / stage.display_rate_hz;
    for (double earlier_s : {0.75, 0.5, 0.25, 0.0})
      world.move_effector(hand.at(std::max(0.0, t_s - earlier_s / stage.display_rate_hz)));
    const DisplayedFrame frame = world.picture(t_s);
    perception.see(frame);
    hand.see(frame);
  }
  return perception.percepts_mm();
}

std::vector<double> percepts_mm(const ResponderParameters& parameters,
                                const std::vector<double>& masses_g, double rate_hz = 15) {
  const Stage stage = fake::row_of(static_cast<int>(masses_g.size()), rate_hz);
  return percepts_mm(parameters, stage, World(stage, "C2", masses_g));
}

// Offline judging uses only the frames with touches.
TEST(Perception, FramesWithoutTouchesShowNothing) {
  const Stage stage = fake::row_of(3, 15);
  const TrialView trial{1, 1, "sorting", stage};
  Hand hand(default_parameters(), 9, trial);
  World world(stage, "C2", {15, 200, 800});
  hand.explore(std::vector<int>{0, 1, 2});
  world.show_cubes();
  std::vector<DisplayedFrame> frames;
  for (int i = 0; i < 600; ++i) {
    const double t_s = i / stage.display_rate_hz;
    world.move_effector(hand.at(t_s));
    frames.push_back(world.picture(t_s));
    hand.see(frames.back());
  }
  frames[40].tracked = false;
  const auto some = frames_with_touches(frames, stage);
  EXPECT_LT(some.size(), frames.size() * 2 / 3);
  Perception of_all(default_parameters(), 9, trial), of_some(default_parameters(), 9, trial);
  for (const DisplayedFrame& frame : frames) of_all.see(frame);
  for (const DisplayedFrame& frame : some) of_some.see(frame);
  EXPECT_GT(of_all.percepts_mm()[1], 5);
  EXPECT_EQ(of_some.percepts_mm(), of_all.percepts_mm());
}

TEST(Perception, PerceptsGrowWithMassUntilTheCubeDoesNotMove) {
  double last_mm = 0;
  for (double mass_g : {15, 30, 60, 100, 150, 200, 300, 400}) {
    const double percept_mm = percepts_mm(noiseless(), {mass_g, 10}).front();
    EXPECT_GT(percept_mm, last_mm) << mass_g << " g";
    last_mm = percept_mm;
  }
  const double heavy_mm = percepts_mm(noiseless(), {1000, 10}).front();
  EXPECT_GT(heavy_mm, last_mm);
  EXPECT_EQ(percepts_mm(noiseless(), {1500, 10}).front(), heavy_mm);
}

TEST(Perception, AttributesTheOffsetToTheCubeThatIsPushed) {
  const auto percepts = percepts_mm(noiseless(), {200, 15, 400});
  EXPECT_NEAR(percepts[0], 0.157 * 200, 3);
  EXPECT_NEAR(percepts[1], 0.157 * 15, 0.5);
  EXPECT_NEAR(percepts[2], 0.157 * 400, 6);
}

TEST(Perception, InC1OrWithoutACloneEveryPerceptIsExactlyNothing) {
  const Stage stage = fake::row_of(3);
  const std::vector<double> masses{15, 200, 800};
  EXPECT_THAT(percepts_mm(default_parameters(), stage, World(stage, "C1", masses)),
              ElementsAre(0, 0, 0));
  EXPECT_THAT(percepts_mm(default_parameters(), stage, World(stage, "C2", masses, false)),
              ElementsAre(0, 0, 0));
}

TEST(Perception, OffsetsThatAreNotVisibleAreNothing) {
  ResponderParameters parameters = default_parameters();
  parameters.just_visible_mm = 5;
  const auto percepts = percepts_mm(parameters, {15, 200});
  EXPECT_EQ(percepts[0], 0);
  EXPECT_GT(percepts[1], 20);
}

TEST(Perception, HalfThePicturesShowSomethingElse) {
  for (const auto& parameters : {default_parameters(), noiseless()}) {
    const auto at_15 = percepts_mm(parameters, {100, 200, 300}, 15);
    const auto at_7 = percepts_mm(parameters, {100, 200, 300}, 7.5);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NE(at_15[i], at_7[i]);
  }
}

TEST(Perception, TheMissingMotionOfACubeIsACueAsWell) {
  ResponderParameters parameters = noiseless();
  parameters.cue = Cue::cube_motion;
  double last_mm = 0;
  for (double mass_g : {30, 100, 200, 400}) {
    const double percept_mm = percepts_mm(parameters, {mass_g, 10}).front();
    EXPECT_GT(percept_mm, last_mm) << mass_g << " g";
    last_mm = percept_mm;
  }
  // In C1 the percept is the distance that the tip moves before it meets the cube, for any mass.
  const Stage stage = fake::row_of(2);
  const auto in_C1 = percepts_mm(parameters, stage, World(stage, "C1", {15, 800}));
  for (double percept_mm : in_C1) EXPECT_LE(percept_mm, 4.001);
  EXPECT_EQ(percepts_mm(parameters, stage, World(stage, "C1", {800, 15})), in_C1);
}

class PictureTest : public testing::Test {
 protected:
  // The clone's tip at a cube's near face, 20 mm behind the effector's.
  DisplayedFrame touching(int cube, double t_s) const {
    DisplayedFrame frame;
    frame.t_s = t_s;
    for (const auto& slot : stage_.slots_m) frame.cubes.push_back(upright_pose(slot, 0));
    const Eigen::Vector3d center_m =
        stage_.slots_m[static_cast<std::size_t>(cube)] - Eigen::Vector3d(0, 0.0175 + 0.045, 0);
    frame.clone = frame.effector = upright_pose(center_m, std::numbers::pi / 2);
    frame.effector.position_m.y() += 0.02;
    return frame;
  }

  Stage stage_ = fake::row_of(2);
  Perception perception_{noiseless(), 1, {1, 1, "comparison", stage_}};
};

TEST_F(PictureTest, ACubeCountsAsLookedAtOnceItIsSeenTouched) {
  EXPECT_THAT(perception_.not_looked_at(), ElementsAre(0, 1));
  perception_.see(touching(1, 1));
  EXPECT_THAT(perception_.not_looked_at(), ElementsAre(0));
  perception_.forget();
  EXPECT_THAT(perception_.not_looked_at(), ElementsAre(0, 1));
}

// The pictures are further apart than the eye's integration time, so that each counts in full.
TEST_F(PictureTest, ThePerceptIsTheMeanOfLooks) {
  perception_.see(touching(1, 1));  // its first picture has lasted for no time yet: 0 mm
  perception_.see(touching(1, 5));
  EXPECT_NEAR(perception_.percepts_mm()[1], 10, 1e-9);
  perception_.see(touching(1, 9));
  EXPECT_NEAR(perception_.percepts_mm()[1], 40.0 / 3, 1e-9);
}

TEST_F(PictureTest, AnotherCubeIsAnotherLookEvenAtOnce) {
  perception_.see(touching(1, 1));
  perception_.see(touching(1, 5));
  perception_.see(touching(0, 5.1));
  EXPECT_THAT(perception_.not_looked_at(), ElementsAre());
  EXPECT_NEAR(perception_.percepts_mm()[0], 20 * (1 - std::exp(-1)), 1e-9);
  EXPECT_NEAR(perception_.percepts_mm()[1], 10, 1e-9);
}

TEST_F(PictureTest, AnEffectorOutOfViewShowsNothing) {
  perception_.see(touching(1, 1));
  DisplayedFrame frame = touching(1, 5);
  frame.tracked = false;
  perception_.see(frame);
  EXPECT_EQ(perception_.percepts_mm()[1], 0);
}

}  // namespace
}  // namespace heft
