// Tests of a live camera that need no device.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/videodev2.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <opencv2/videoio.hpp>

#include "base/Error.h"
#include "record/temporary_folder.h"
#include "tracking/camera/LiveCamera.h"
#include "tracking/camera/VideoDevices.h"

namespace heft {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(CaptureTime, IsTheMiddleOfTheExposureOfABelievableDriver) {
  EXPECT_DOUBLE_EQ(capture_time_s(99.95, 100, 0.004), 99.948);
  EXPECT_DOUBLE_EQ(capture_time_s(100, 100, 0.004), 99.998);
}

TEST(CaptureTime, IsArrivalWhereTheDriverReportsNonsense) {
  for (const double driver_s : {0.0, 42.0, 98.9, 100.5, 1.7e9})
    EXPECT_DOUBLE_EQ(capture_time_s(driver_s, 100, 0.004), 99.998) << driver_s;
}

// Accepts the properties that exist, as drivers do, and refuses others.
CameraControls controls_of(std::map<int, double>& properties) {
  return {[&properties](int property, double value) {
            const auto found = properties.find(property);
            if (found == properties.end()) return false;
            found->second = value;
            return true;
          },
          [&properties](int property) {
            const auto found = properties.find(property);
            return found == properties.end() ? -1 : found->second;
          }};
}

TEST(LockControls, ListsWhatTheDriverFixed) {
  std::map<int, double> properties{{cv::CAP_PROP_AUTO_EXPOSURE, 3},
                                   {cv::CAP_PROP_EXPOSURE, 250},
                                   {cv::CAP_PROP_AUTOFOCUS, 1},
                                   {cv::CAP_PROP_AUTO_WB, 1}};
  CameraMode mode;
  lock_controls(controls_of(properties), {}, mode);
  EXPECT_THAT(mode.locked, ElementsAre("exposure 4.0 ms", "focus", "white balance"));
  EXPECT_THAT(mode.not_locked, IsEmpty());
  EXPECT_EQ(properties[cv::CAP_PROP_AUTO_EXPOSURE], 1);  // V4L2_EXPOSURE_MANUAL
  EXPECT_EQ(properties[cv::CAP_PROP_EXPOSURE], 40);      // in 100 microseconds
  EXPECT_EQ(properties[cv::CAP_PROP_AUTOFOCUS], 0);
}

TEST(LockControls, SaysWhatAMissingLockMeans) {
  std::map<int, double> properties{{cv::CAP_PROP_AUTO_WB, 1}};
  CameraMode mode;
  lock_controls(controls_of(properties), {}, mode);
  EXPECT_THAT(mode.locked, ElementsAre("white balance"));
  EXPECT_THAT(mode.not_locked, ElementsAre(HasSubstr("blurred"), HasSubstr("calibration")));
}

TEST(LockControls, BelievesWhatItReadsBackNotWhatSetSays) {
  CameraMode mode;
  const auto longer = [](int property) { return property == cv::CAP_PROP_EXPOSURE ? 333.0 : 1.0; };
  lock_controls({[](int, double) { return true; }, longer}, {}, mode);
  EXPECT_THAT(mode.locked, IsEmpty());
  ASSERT_FALSE(mode.not_locked.empty());
  EXPECT_THAT(mode.not_locked[0], HasSubstr("33.3 ms instead of 4.0 ms"));
  EXPECT_FALSE(mode.held.exposure_s);
}

// The settings at calibration are stored in the camera's file and requested in later sessions.
TEST(LockControls, AskForWhatTheCameraWasCalibratedAt) {
  std::map<int, double> properties{{cv::CAP_PROP_AUTO_EXPOSURE, 3},
                                   {cv::CAP_PROP_EXPOSURE, 250},
                                   {cv::CAP_PROP_AUTOFOCUS, 1},
                                   {cv::CAP_PROP_FOCUS, 35},
                                   {cv::CAP_PROP_AUTO_WB, 1}};
  CameraRequest asked{1280, 720};
  asked.exposure_s = 0.0025;
  CameraMode mode;
  lock_controls(controls_of(properties), asked, mode);
  EXPECT_THAT(mode.locked, ElementsAre("exposure 2.5 ms", "focus 35", "white balance"));
  Intrinsics camera{1280, 720, 1000, 1000, 640, 360};
  camera.calibrated_at = mode.held;

  properties = {{cv::CAP_PROP_AUTO_EXPOSURE, 3},
                {cv::CAP_PROP_EXPOSURE, 250},
                {cv::CAP_PROP_AUTOFOCUS, 1},
                {cv::CAP_PROP_FOCUS, 120}};
  const CameraRequest again = request_for(parse_intrinsics(to_yaml(camera, ""), "c.yaml"), 15);
  EXPECT_EQ(again.width_px, 1280);
  EXPECT_EQ(again.height_px, 720);
  lock_controls(controls_of(properties), again, mode);
  EXPECT_EQ(properties[cv::CAP_PROP_EXPOSURE], 25);
  EXPECT_EQ(properties[cv::CAP_PROP_AUTOFOCUS], 0);
  EXPECT_EQ(properties[cv::CAP_PROP_FOCUS], 35);
}

TEST(LockControls, SaysWhereTheLensIsNotWhereItWasCalibrated) {
  CameraRequest request;
  request.focus = 35;
  std::map<int, double> without_control{{cv::CAP_PROP_AUTOFOCUS, 1}};
  CameraMode mode;
  lock_controls(controls_of(without_control), request, mode);
  EXPECT_THAT(mode.not_locked, Contains(HasSubstr("calibrated at 35, but this driver cannot")));
  EXPECT_FALSE(mode.held.focus);

  const auto elsewhere = [](int property) { return property == cv::CAP_PROP_FOCUS ? 120.0 : 0.0; };
  mode = {};
  lock_controls({[](int, double) { return true; }, elsewhere}, request, mode);
  EXPECT_THAT(mode.not_locked, Contains(AllOf(HasSubstr("calibrated at 35, but it is at 120"),
                                              HasSubstr("calibrate again"))));
}

// Some versions of OpenCV return 0 for properties that a driver lacks.
TEST(LockControls, KeepsNoFocusThatCanNotBeSet) {
  const auto set = [](int property, double) { return property != cv::CAP_PROP_FOCUS; };
  CameraMode mode;
  lock_controls({set, [](int) { return 0.0; }}, {}, mode);
  EXPECT_THAT(mode.locked, Contains("focus"));
  EXPECT_FALSE(mode.held.focus);
}

TEST(RequestFor, IsTheUsualOneWhereTheFileShowsNothing) {
  const CameraRequest request = request_for(parse_intrinsics(to_yaml({}, ""), "c.yaml"), 15);
  EXPECT_EQ(request.exposure_s, CameraRequest{}.exposure_s);
  EXPECT_EQ(request.rate_hz, 30);
  EXPECT_FALSE(request.focus);
}

// A V4L2 driver with these controls, some of which keep their values when set.
struct FakeDriver {
  std::map<std::uint32_t, int> values;
  std::vector<std::uint32_t> fixed;

  CameraMode locked(CameraMode mode = {}) {
    lock_driver_controls(
        [this](unsigned long request, void* argument) {
          if (request == VIDIOC_QUERYCTRL)
            return values.contains(static_cast<v4l2_queryctrl*>(argument)->id) ? 0 : -1;
          auto& control = *static_cast<v4l2_control*>(argument);
          const auto found = values.find(control.id);
          if (found == values.end()) return -1;
          const bool is_fixed = std::ranges::count(fixed, control.id) > 0;
          if (request == VIDIOC_S_CTRL && !is_fixed) found->second = control.value;
          if (request == VIDIOC_G_CTRL) control.value = found->second;
          return 0;
        },
        mode);
    return mode;
  }
};

TEST(DriverControls, AreSetReadBackAndListed) {
  FakeDriver driver{{{V4L2_CID_AUTOGAIN, 1},
                     {V4L2_CID_GAIN, 12},
                     {V4L2_CID_POWER_LINE_FREQUENCY, V4L2_CID_POWER_LINE_FREQUENCY_AUTO},
                     {V4L2_CID_EXPOSURE_AUTO_PRIORITY, 1},
                     {V4L2_CID_WHITE_BALANCE_TEMPERATURE, 4600}},
                    {}};
  CameraMode balanced;
  balanced.locked = {"white balance"};
  const CameraMode mode = driver.locked(balanced);
  EXPECT_THAT(mode.locked, ElementsAre("white balance 4600 K", "gain 12", "power line 50 Hz",
                                       "dynamic frame rate off"));
  EXPECT_THAT(mode.not_locked, IsEmpty());
  EXPECT_EQ(driver.values[V4L2_CID_AUTOGAIN], 0);
  EXPECT_EQ(driver.values[V4L2_CID_POWER_LINE_FREQUENCY], V4L2_CID_POWER_LINE_FREQUENCY_50HZ);
  EXPECT_EQ(driver.values[V4L2_CID_EXPOSURE_AUTO_PRIORITY], 0);
  driver.values[V4L2_CID_POWER_LINE_FREQUENCY] = V4L2_CID_POWER_LINE_FREQUENCY_60HZ;
  EXPECT_THAT(driver.locked().locked, Contains("power line 60 Hz"));
}

TEST(DriverControls, ThatDoNotChangeAreNamedWithTheirConsequence) {
  FakeDriver driver{
      {{V4L2_CID_AUTOGAIN, 1},
       {V4L2_CID_POWER_LINE_FREQUENCY, 0},
       {V4L2_CID_EXPOSURE_AUTO_PRIORITY, 1}},
      {V4L2_CID_AUTOGAIN, V4L2_CID_POWER_LINE_FREQUENCY, V4L2_CID_EXPOSURE_AUTO_PRIORITY}};
  const CameraMode mode = driver.locked();
  EXPECT_THAT(mode.locked, IsEmpty());
  EXPECT_THAT(mode.not_locked, ElementsAre(HasSubstr("brightness"), HasSubstr("flicker"),
                                           HasSubstr("fewer pictures")));
}

TEST(DriverControls, ThatADriverLacksAreNotListed) {
  const CameraMode mode = FakeDriver{}.locked();
  EXPECT_THAT(mode.locked, IsEmpty());
  EXPECT_THAT(mode.not_locked, IsEmpty());
}

TEST(VideoDevices, AreListedByNumber) {
  const test::TemporaryFolder folder;
  for (const char* name : {"video10", "video9731", "video2", "video", "videox", "v4l", "null"})
    std::ofstream(folder.file(name)).put('x');
  std::vector<int> numbers;
  for (const VideoDevice& device : video_devices(folder.path())) numbers.push_back(device.number);
  EXPECT_THAT(numbers, ElementsAre(2, 10, 9731));
}

TEST(VideoDevices, AMissingOneNamesThoseThatAreThere) {
  const test::TemporaryFolder folder;
  const auto message = [&] {
    try {
      check_device(0, folder.path());
    } catch (const Error& error) {
      EXPECT_EQ(error.exit_code(), ExitCode::device_missing);
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(message(), HasSubstr("none is connected"));
  std::ofstream(folder.file("video9731")).put('x');
  EXPECT_THAT(message(), HasSubstr("/dev/video9731"));
  EXPECT_NO_THROW(check_device(9731, folder.path()));
}

TEST(VideoDevices, WhatIsNoCameraHasNoModes) {
  const test::TemporaryFolder folder;
  std::ofstream(folder.file("video3")).put('x');
  EXPECT_THAT(device_modes({3, ""}, folder.path()), IsEmpty());
  EXPECT_THAT(device_modes({4, ""}, folder.path()), IsEmpty());
}

TEST(VideoDevices, ANumberIsAWholeOne) {
  EXPECT_EQ(device_number("0"), 0);
  EXPECT_EQ(device_number("12"), 12);
  for (const char* text : {"", "x", "-1", "1.5", "0x", "99999999999"}) {
    try {
      device_number(text);
      ADD_FAILURE() << text;
    } catch (const Error& error) {
      EXPECT_EQ(error.exit_code(), ExitCode::usage) << text;
    }
  }
}

}  // namespace
}  // namespace heft
