// Controls of a V4L2 driver that OpenCV lacks.
#include <fcntl.h>
#include <fmt/format.h>
#include <linux/videodev2.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>

#include "tracking/camera/LiveCamera.h"

namespace heft {

namespace {
// None if the driver lacks the control, or cannot read it now.
std::optional<int> value_of(const DeviceRequest& device, std::uint32_t id) {
  v4l2_queryctrl query{};
  query.id = id;
  if (device(VIDIOC_QUERYCTRL, &query) != 0 || (query.flags & V4L2_CTRL_FLAG_DISABLED) != 0)
    return std::nullopt;
  v4l2_control control{};
  control.id = id;
  if (device(VIDIOC_G_CTRL, &control) != 0) return std::nullopt;
  return control.value;
}

bool takes(const DeviceRequest& device, std::uint32_t id, int value) {
  v4l2_control control{};
  control.id = id;
  control.value = value;
  return device(VIDIOC_S_CTRL, &control) == 0 && value_of(device, id) == value;
}

void lock_gain(const DeviceRequest& device, CameraMode& mode) {
  const auto automatic = value_of(device, V4L2_CID_AUTOGAIN);
  const auto gain = value_of(device, V4L2_CID_GAIN);
  if (!automatic && !gain) return;
  if (automatic && !takes(device, V4L2_CID_AUTOGAIN, 0))
    mode.not_locked.emplace_back(
        "gain: chosen by the camera, so brightness and noise follow the light; keep it constant");
  else if (gain && !takes(device, V4L2_CID_GAIN, *gain))
    mode.not_locked.push_back(fmt::format("gain: at {}, but the driver does not hold it", *gain));
  else
    mode.locked.push_back(gain ? fmt::format("gain {}", *gain) : "gain");
}

// Locks 60 Hz if that is set, otherwise 50 Hz.
void lock_power_line(const DeviceRequest& device, CameraMode& mode) {
  const auto now = value_of(device, V4L2_CID_POWER_LINE_FREQUENCY);
  if (!now) return;
  const bool is_60 = *now == V4L2_CID_POWER_LINE_FREQUENCY_60HZ;
  const int wanted =
      is_60 ? V4L2_CID_POWER_LINE_FREQUENCY_60HZ : V4L2_CID_POWER_LINE_FREQUENCY_50HZ;
  if (takes(device, V4L2_CID_POWER_LINE_FREQUENCY, wanted))
    mode.locked.push_back(fmt::format("power line {} Hz", is_60 ? 60 : 50));
  else
    mode.not_locked.emplace_back(
        "power line: the camera refuses 50 Hz, so lamps may flicker in pictures; use daylight or "
        "lamps that do not flicker");
}

void lock_frame_rate(const DeviceRequest& device, CameraMode& mode) {
  if (!value_of(device, V4L2_CID_EXPOSURE_AUTO_PRIORITY)) return;
  if (takes(device, V4L2_CID_EXPOSURE_AUTO_PRIORITY, 0))
    mode.locked.emplace_back("dynamic frame rate off");
  else
    mode.not_locked.emplace_back(
        "dynamic frame rate: the camera takes fewer pictures in dim light; add light");
}

// The temperature can be read once the balance is manual.
void read_white_balance(const DeviceRequest& device, CameraMode& mode) {
  const auto at = std::ranges::find(mode.locked, "white balance");
  if (at == mode.locked.end()) return;
  if (const auto kelvin = value_of(device, V4L2_CID_WHITE_BALANCE_TEMPERATURE))
    *at = fmt::format("white balance {} K", *kelvin);
}
}  // namespace

void lock_driver_controls(const DeviceRequest& device, CameraMode& mode) {
  lock_gain(device, mode);
  lock_power_line(device, mode);
  lock_frame_rate(device, mode);
  read_white_balance(device, mode);
}

void lock_driver_controls(const std::string& path, CameraMode& mode) {
  const int file = open(path.c_str(), O_RDWR | O_NONBLOCK);
  if (file < 0) return;
  lock_driver_controls(
      [file](unsigned long request, void* argument) { return ioctl(file, request, argument); },
      mode);
  close(file);
}

}  // namespace heft
