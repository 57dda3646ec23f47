// Tracker "mouse": pictures of the effector at its dragged pose at their time.
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "apparatus/ShippedApparatus.h"
#include "apparatus/sources/DraggedPictures.h"
#include "base/Error.h"
#include "base/PoseTypes.h"
#include "protocol/readers/Files.h"

namespace heft {
namespace {

class Dragged : public testing::Test {
 protected:
  PictureParts parts() {
    PictureParts all{protocol, *hand, shipped_apparatus(), "", clock, 0, ""};
    all.dragged = effector;
    return all;
  }

  static Picture waited_for(PictureSource& pictures) {
    for (;;) {
      if (auto picture = pictures.next()) return *picture;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }

  Protocol protocol;
  std::unique_ptr<Responder> hand = responder_named("simulated").make({});
  SessionClock clock = SessionClock::wall_from(0);
  std::shared_ptr<DraggedEffector> effector =
      std::make_shared<DraggedEffector>(DraggedEffector{upright_pose({0, -0.12, 0.025}, 1.57)});
};

TEST_F(Dragged, HasThePoseThatItWasDraggedToAtThatTime) {
  DraggedPictures pictures(parts());
  pictures.begin_attempt({clock.now_s(), 1, 1});
  const Picture first = waited_for(pictures);
  EXPECT_FALSE(pictures.next()) << "the next one's time has not come";
  effector->pose.position_m.x() = 0.03;
  const Picture second = waited_for(pictures);
  const double passed_s = second.sample.t_capture_s - first.sample.t_capture_s;
  EXPECT_GE(second.sample.t_capture_s, 1 / protocol.display_rate_hz);
  EXPECT_EQ(first.sample.pose.position_m.x(), 0);
  EXPECT_EQ(first.sample.velocity.linear_m_s.x(), 0);
  EXPECT_EQ(second.sample.pose.position_m.x(), 0.03);
  EXPECT_NEAR(second.sample.velocity.linear_m_s.x(), 0.03 / passed_s, 1e-12);
  EXPECT_TRUE(second.sample.tracked);
}

// Skin has much more red than blue, unlike wood; no hand may be visible.
TEST_F(Dragged, FilmsTheEffectorAndNoHand) {
  const auto skin_px = [](const Image& image) {
    int n = 0;
    for (std::size_t i = 0; i + 2 < image.pixels.size(); i += 3)
      n += image.pixels[i + 2] > 190 && image.pixels[i + 2] - image.pixels[i] > 60;
    return n;
  };
  DraggedPictures pictures(parts());
  pictures.begin_attempt({clock.now_s(), 1, 1});
  const Picture picture = waited_for(pictures);
  ASSERT_TRUE(picture.camera && picture.camera_from_board);
  SyntheticSettings with_hand;
  const PictureParts all = parts();
  SyntheticCamera camera(all.apparatus, with_hand, 0);
  const auto still = [&](double) { return std::optional(effector->pose); };
  EXPECT_GT(skin_px(camera.picture(still, 0, 0)), 2000);
  EXPECT_LT(skin_px(*picture.camera), 200);
}

TEST_F(Dragged, WithoutAWindowToDragInIsRefused) {
  effector.reset();
  EXPECT_THROW(DraggedPictures{parts()}, Error);
}

}  // namespace
}  // namespace heft
