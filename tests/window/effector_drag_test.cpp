// The dragged effector: where it is taken, how it follows, and its limits.
#include <gtest/gtest.h>

#include <cmath>

#include "base/PoseTypes.h"
#include "view/EveryScreen.h"
#include "window/WindowView.h"

namespace heft {
namespace {

using Eigen::Vector3d;

class Drag : public testing::Test {
 protected:
  static ViewSetup setup_with(const std::shared_ptr<DraggedEffector>& effector) {
    ViewSetup setup;
    setup.dragged = effector;
    return setup;
  }

  std::shared_ptr<DraggedEffector> effector =
      std::make_shared<DraggedEffector>(DraggedEffector{upright_pose({0, -0.1, 0.025}, M_PI / 2)});
  EffectorDrag drag{setup_with(effector)};
};

TEST_F(Drag, EffectorFollowsWithoutAJump) {
  drag.take(Taps::mouse, {0.05, -0.1, 0.025});
  EXPECT_FALSE(drag.was_taken()) << "beside it";
  drag.take(Taps::mouse, {0.01, -0.14, 0.025});
  ASSERT_TRUE(drag.is_held_by(Taps::mouse)) << "near its back end";
  drag.move(Taps::mouse, {0.01, -0.14, 0.025});
  EXPECT_EQ(effector->pose.position_m, Vector3d(0, -0.1, 0.025));
  drag.move(Taps::mouse, {0.04, -0.04, 0.025});
  EXPECT_TRUE(effector->pose.position_m.isApprox(Vector3d(0.03, 0, 0.025), 1e-12));
}

TEST_F(Drag, OnePointerHoldsItUntilRelease) {
  constexpr Taps::Pointer finger = 3;
  const Vector3d middle = effector->pose.position_m;
  drag.take(finger, middle);
  drag.take(Taps::mouse, middle);
  drag.move(Taps::mouse, {0.1, 0.1, 0.025});
  EXPECT_EQ(effector->pose.position_m, middle) << "a second one turns it only";
  drag.let_go(Taps::mouse);
  EXPECT_TRUE(drag.is_held_by(finger));
  drag.let_go(finger);
  drag.move(finger, {0.1, 0.1, 0.025});
  EXPECT_EQ(effector->pose.position_m, middle);
}

TEST_F(Drag, TheCloneCanBeTakenWhichIsAllThatIsSeenOfIt) {
  drag.set_clone(upright_pose({0, -0.03, 0.025}, M_PI / 2));
  drag.take(Taps::mouse, {0, 0.005, 0.025});
  ASSERT_TRUE(drag.is_held_by(Taps::mouse)) << "at the clone's tip, ahead of the effector's";
  drag.move(Taps::mouse, {0.02, -0.045, 0.025});
  EXPECT_TRUE(effector->pose.position_m.isApprox(Vector3d(0.02, -0.15, 0.025), 1e-12));
  drag.let_go();
  drag.set_clone({});
  drag.take(Taps::mouse, {0, 0.005, 0.025});
  EXPECT_FALSE(drag.is_held()) << "there is no clone any more";
}

TEST_F(Drag, ASecondFingerTurnsItAboutTheFirst) {
  constexpr Taps::Pointer first = 1, second = 2, third = 3;
  const Vector3d middle = effector->pose.position_m;
  const auto yaw_rad = [&] {
    const Vector3d tip = effector->pose.orientation * Vector3d::UnitX();
    return std::atan2(tip.y(), tip.x());
  };
  drag.take(first, middle);
  drag.take(second, middle + Vector3d(0.1, 0, 0));
  drag.take(third, middle + Vector3d(0, 0.1, 0));
  drag.move(third, middle);
  EXPECT_NEAR(yaw_rad(), M_PI / 2, 1e-12) << "a third one does nothing";
  drag.move(second, middle + Vector3d(0.1, 0.1, 0));
  EXPECT_NEAR(yaw_rad(), 3 * M_PI / 4, 1e-12);
  EXPECT_EQ(effector->pose.position_m, middle);
  drag.move(first, middle + Vector3d(0.1, 0, 0));
  EXPECT_NEAR(yaw_rad(), M_PI, 1e-9) << "both fingers turn it";
  EXPECT_NEAR(effector->pose.position_m.x(), middle.x() + 0.1, 1e-12);
  drag.let_go(second);
  drag.move(second, middle);
  EXPECT_NEAR(yaw_rad(), M_PI, 1e-9);
  EXPECT_TRUE(drag.is_held_by(first));
  drag.let_go(first);
  EXPECT_FALSE(drag.is_held());
}

TEST_F(Drag, EffectorRemainsInItsAreaAndAtItsHeight) {
  drag.take(Taps::mouse, effector->pose.position_m);
  drag.move(Taps::mouse, {7, -7, 0.025});
  EXPECT_EQ(effector->pose.position_m, Vector3d(0.2, -0.15, 0.025));
}

TEST_F(Drag, WheelTurnsItAboutTheVertical) {
  drag.turn(18);
  const Vector3d tip = effector->pose.orientation * Vector3d::UnitX();
  EXPECT_NEAR(tip.x(), -1, 1e-12);
  EXPECT_NEAR(tip.z(), 0, 1e-12);
  EXPECT_EQ(effector->pose.position_m, Vector3d(0, -0.1, 0.025));
  EXPECT_TRUE(drag.is_at({-0.04, -0.1, 0.025}));
  EXPECT_FALSE(drag.is_at({0, -0.14, 0.025}));
}

}  // namespace
}  // namespace heft
