// The board counts as lost after half a second without it; the time restarts after each pause.
#include <gtest/gtest.h>

#include "apparatus/ShippedApparatus.h"
#include "apparatus/sources/FilmedPictures.h"

namespace heft {
namespace {

std::string trouble_at(PictureTracker& tracker, double t_s) {
  return tracker.track(std::make_shared<const Image>(640, 480, 3), t_s).trouble;
}

TEST(PictureTracker, ABoardIsLostAfterHalfASecondWithoutIt) {
  PictureTracker tracker(shipped_apparatus());
  EXPECT_EQ(trouble_at(tracker, 1), "");
  EXPECT_EQ(trouble_at(tracker, 1.4), "");
  EXPECT_EQ(trouble_at(tracker, 1.6), "board_lost");
}

TEST(PictureTracker, OnePictureWithoutBoardAfterABreakIsNoLostBoard) {
  PictureTracker tracker(shipped_apparatus());
  trouble_at(tracker, 1);
  tracker.look_again();  // as after a break, a pause, between attempts
  EXPECT_EQ(trouble_at(tracker, 61), "");
  EXPECT_EQ(trouble_at(tracker, 61.4), "");
  EXPECT_EQ(trouble_at(tracker, 61.6), "board_lost");
}

}  // namespace
}  // namespace heft
