// Which pictures of a source are shown at a display's rate, and which of them count as dropped.
#include <gmock/gmock.h>

#include <thread>

#include "apparatus/ShippedApparatus.h"
#include "apparatus/sources/FilmedPictures.h"
#include "apparatus/sources/PacedPictures.h"
#include "tracking/camera/LiveCamera.h"

namespace heft {
namespace {

using ::testing::AllOf;
using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::Ge;
using ::testing::Le;
using ::testing::Pointwise;
using ::testing::SizeIs;

// Returns the pictures that it was constructed with.
class MadeUpPictures final : public PictureSource {
 public:
  explicit MadeUpPictures(std::vector<Picture> pictures) : pictures_(std::move(pictures)) {}
  void begin_attempt(const AttemptStart&) override {}
  std::optional<Picture> next() override {
    return ended() ? std::nullopt : std::optional(pictures_[next_++]);
  }
  bool ended() const override { return next_ == pictures_.size(); }

 private:
  std::vector<Picture> pictures_;
  std::size_t next_ = 0;
};

std::vector<Picture> at_times(const std::vector<double>& times_s) {
  std::vector<Picture> pictures;
  for (const double t_s : times_s) pictures.emplace_back().sample.t_capture_s = t_s;
  return pictures;
}

std::vector<double> regular(double rate_hz, int n, double jitter_s = 0) {
  std::vector<double> times_s;
  for (int i = 0; i < n; ++i) times_s.push_back(i / rate_hz + (i % 3 - 1) * jitter_s);
  return times_s;
}

std::vector<Picture> shown_of(std::vector<Picture> pictures, double display_rate_hz) {
  PacedPictures paced(std::make_unique<MadeUpPictures>(std::move(pictures)), display_rate_hz);
  paced.begin_attempt({});
  std::vector<Picture> shown;
  while (auto picture = paced.next()) shown.push_back(std::move(*picture));
  EXPECT_TRUE(paced.ended());
  return shown;
}

std::vector<double> times_of(const std::vector<Picture>& pictures) {
  std::vector<double> times_s;
  for (const Picture& picture : pictures) times_s.push_back(picture.sample.t_capture_s);
  return times_s;
}

TEST(PacedPictures, OfTwiceAsManyEverySecondIsShownAtItsOwnTime) {
  EXPECT_THAT(times_of(shown_of(at_times(regular(30, 300)), 15)),
              Pointwise(DoubleNear(1e-12), regular(15, 150)));
}

TEST(PacedPictures, JitterOfACameraDoesNotChangeWhichAreShown) {
  const auto shown = times_of(shown_of(at_times(regular(30, 300, 0.006)), 15));
  ASSERT_THAT(shown, SizeIs(150));
  for (std::size_t i = 0; i < shown.size(); ++i)
    EXPECT_NEAR(shown[i], static_cast<double>(i) / 15, 0.0061) << i;
}

TEST(PacedPictures, OfAnyFasterSourceTheRateIsTheDisplays) {
  for (const double rate_hz : {20.0, 24.0, 25.0, 29.97, 50.0, 59.94, 60.0, 100.0, 144.0}) {
    const int n = static_cast<int>(20 * rate_hz);
    EXPECT_NEAR(static_cast<double>(shown_of(at_times(regular(rate_hz, n)), 15).size()), 300, 1)
        << rate_hz;
  }
}

TEST(PacedPictures, OfASlowerOrEqualSourceAllAreShown) {
  for (const double rate_hz : {5.0, 10.0, 14.9, 15.0})
    EXPECT_THAT(shown_of(at_times(regular(rate_hz, 100, 0.005)), 15), SizeIs(100)) << rate_hz;
}

TEST(PacedPictures, NeverCatchUpAfterAGap) {
  std::vector<double> times_s = regular(30, 31);
  for (int i = 0; i < 30; ++i) times_s.push_back(3 + i / 30.0);
  const auto shown = times_of(shown_of(at_times(times_s), 15));
  EXPECT_THAT(shown, SizeIs(16 + 15));
  for (std::size_t i = 17; i < shown.size(); ++i) EXPECT_GT(shown[i] - shown[i - 1], 0.05) << i;
}

TEST(PacedPictures, LostInBetweenAreNotDropped) {
  auto pictures = at_times(regular(30, 60));
  std::erase_if(pictures, [i = 0](const Picture&) mutable { return i++ % 2 == 1; });
  for (Picture& picture : pictures) picture.n_dropped = 1;  // of the camera, nobody misses them
  int n_dropped = 0;
  for (const Picture& picture : shown_of(pictures, 15)) n_dropped += picture.n_dropped;
  EXPECT_EQ(n_dropped, 0);
}

TEST(PacedPictures, WhatShouldHaveBeenShownIsDropped) {
  auto pictures = at_times(regular(30, 10));
  pictures.erase(pictures.begin() + 3, pictures.begin() + 8);  // due at 4 and 6
  pictures[3].n_dropped = 5;
  const auto shown = shown_of(pictures, 15);
  ASSERT_THAT(shown, SizeIs(3));
  EXPECT_EQ(shown[2].n_dropped, 2);
}

TEST(PacedPictures, AJumpInBetweenIsNotForgotten) {
  auto pictures = at_times(regular(30, 6));
  pictures[3].sample.jump = true;
  std::vector<bool> jumps;
  for (const Picture& picture : shown_of(pictures, 15)) jumps.push_back(picture.sample.jump);
  EXPECT_THAT(jumps, ElementsAre(false, false, true));
}

// A live camera with 60 pictures a second, without an effector.
TEST(PacedPictures, OfALiveCameraComeAtTheDisplaysRateAndNoneIsDropped) {
  std::uint8_t shade = 0;
  const auto grab = [&]() -> std::optional<GrabbedPicture> {
    std::this_thread::sleep_for(std::chrono::microseconds(16667));
    Image image(640, 480, 1);
    image.pixels.assign(image.pixels.size(), ++shade);
    return GrabbedPicture{std::move(image), monotonic_s()};
  };
  const SessionClock clock = SessionClock::wall_from(0);
  const auto hand = responder_named("simulated").make({});
  Protocol protocol;
  PacedPictures paced(
      std::make_unique<CameraPictures>(
          [&] {
            return std::make_unique<LiveCamera>(grab, CameraMode{640, 480, 60, "YUYV", {}, {}});
          },
          PictureParts{protocol, *hand, shipped_apparatus(), "", clock, 0, ""}),
      15);
  EXPECT_EQ(paced.rate_hz(), 60);
  paced.begin_attempt({});
  std::vector<Picture> shown;
  while (clock.now_s() < 0.8) {
    if (auto picture = paced.next()) shown.push_back(std::move(*picture));
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  EXPECT_THAT(shown.size(), AllOf(Ge(9U), Le(13U)));
  for (const Picture& picture : shown) EXPECT_EQ(picture.n_dropped, 0);
}

}  // namespace
}  // namespace heft
