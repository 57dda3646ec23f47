// LiveCamera with a fake device.
#include <gtest/gtest.h>

#include <atomic>
#include <queue>
#include <semaphore>

#include "base/Error.h"
#include "tracking/camera/LiveCamera.h"

namespace heft {
namespace {

Image gray(std::uint8_t level) {
  Image image(2, 1, 1);
  image.pixels = {level, 7};
  return image;
}

// A device with pictures from the test; without one it returns none immediately, as a driver does.
class FakeDevice {
 public:
  void give(std::uint8_t level, double capture_s) { push({gray(level), capture_s}); }
  void fail() { push({}); }

  // Waits until the thread has taken every given picture and asks for more.
  void wait_until_taken() {
    while (!is_empty()) std::this_thread::yield();
    const int asked = n_asked_;
    while (n_asked_ == asked) std::this_thread::yield();
  }

  LiveCamera::Grab grab() {
    return [this]() -> std::optional<GrabbedPicture> {
      ++n_asked_;
      const std::scoped_lock lock(mutex_);
      if (given_.empty()) return std::nullopt;
      GrabbedPicture picture = std::move(given_.front());
      given_.pop();
      if (picture.image.empty()) return std::nullopt;
      return picture;
    };
  }

 private:
  bool is_empty() {
    const std::scoped_lock lock(mutex_);
    return given_.empty();
  }

  void push(GrabbedPicture picture) {
    const std::scoped_lock lock(mutex_);
    given_.push(std::move(picture));
  }

  std::mutex mutex_;
  std::queue<GrabbedPicture> given_;
  std::atomic<int> n_asked_ = 0;
};

constexpr double soon_s = 0.02, long_s = 20, pause_s = 0.001;

TEST(LiveCamera, GivesAPictureWithItsTimeOnce) {
  FakeDevice device;
  LiveCamera camera(device.grab(), {}, pause_s);
  device.give(10, 1.5);
  const auto picture = camera.next(long_s);
  ASSERT_TRUE(picture);
  EXPECT_EQ(picture->image.pixels, gray(10).pixels);
  EXPECT_EQ(picture->capture_s, 1.5);
  EXPECT_EQ(picture->number, 0);
  EXPECT_FALSE(camera.next(soon_s));
}

TEST(LiveCamera, ASlowReaderGetsTheNewestAndItsNumberCountsTheOthers) {
  FakeDevice device;
  LiveCamera camera(device.grab(), {}, pause_s);
  for (int i = 0; i < 5; ++i) device.give(static_cast<std::uint8_t>(i), 0.1 * i);
  device.wait_until_taken();
  const auto picture = camera.next(long_s);
  ASSERT_TRUE(picture);
  EXPECT_EQ(picture->image.pixels, gray(4).pixels);
  EXPECT_EQ(picture->number, 4);
  EXPECT_FALSE(camera.next(soon_s));
}

TEST(LiveCamera, TheSamePictureOverAndOverIsAFrozenCamera) {
  FakeDevice device;
  LiveCamera camera(device.grab(), {}, pause_s);
  device.give(10, 0);
  ASSERT_TRUE(camera.next(long_s));
  for (int i = 1; i < 20; ++i) device.give(10, i);
  device.wait_until_taken();
  EXPECT_FALSE(camera.next(soon_s));
  device.give(11, 21);
  const auto thawed = camera.next(long_s);
  ASSERT_TRUE(thawed);
  EXPECT_EQ(thawed->capture_s, 21);
}

TEST(LiveCamera, ContinuesAfterADeviceWasUnplugged) {
  FakeDevice device;
  LiveCamera camera(device.grab(), {}, pause_s);
  device.give(1, 0);
  ASSERT_TRUE(camera.next(long_s));
  for (int i = 0; i < 3; ++i) device.fail();
  device.wait_until_taken();
  EXPECT_FALSE(camera.next(soon_s));
  device.give(2, 5);
  const auto picture = camera.next(long_s);
  ASSERT_TRUE(picture);
  EXPECT_EQ(picture->capture_s, 5);
}

TEST(LiveCamera, WhatTheDeviceThrowsReachesTheReaderAfterTheLastPicture) {
  int n = 0;
  LiveCamera camera(
      [&n]() -> std::optional<GrabbedPicture> {
        if (n++ == 0) return GrabbedPicture{gray(10), 1.5};
        throw std::runtime_error("the driver is broken");
      },
      {}, pause_s);
  ASSERT_TRUE(camera.next(long_s));
  for (int i = 0; i < 2; ++i) try {
      camera.next(long_s);
      ADD_FAILURE() << "gave a picture";
    } catch (const Error& error) {
      EXPECT_EQ(error.exit_code(), ExitCode::device_missing);
      EXPECT_NE(std::string(error.what()).find("the driver is broken"), std::string::npos);
    }
}

TEST(LiveCamera, EndsWhileItPausesAfterAFailure) {
  LiveCamera camera([] { return std::nullopt; }, {}, 3600);
  EXPECT_FALSE(camera.next(soon_s));
}  // hangs here if the pause can't be ended

}  // namespace
}  // namespace heft
