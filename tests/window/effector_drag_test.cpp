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
  EXPECT_EQ(effector->pose.position_m, middle);
  drag.let_go(Taps::mouse);
  EXPECT_TRUE(drag.is_held_by(finger));
  drag.let_go(finger);
  drag.move(finger, {0.1, 0.1, 0.025});
  EXPECT_EQ(effector->pose.position_m, middle);
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
