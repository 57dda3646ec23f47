// A live camera, independent of the device: grabs pictures continuously and keeps the newest one,
// because drivers queue about four, and reading only on demand would return old ones. Also computes
// its capture times and locks.
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

#include "tracking/camera/Camera.h"

namespace heft {

struct GrabbedPicture {
  Image image;
  double capture_s = 0;
};

/// Uses any source of pictures: a V4L2 device, or a fake one in tests.
class LiveCamera final : public Camera {
 public:
  /// Waits for the device's next picture. None: no picture at present, to be tried again. Must
  /// return within about a second, so that the thread can be ended.
  using Grab = std::function<std::optional<GrabbedPicture>()>;

  /// @param grab called on a separate thread only  @param pause_s after a grab without a picture
  explicit LiveCamera(Grab grab, CameraMode mode = {}, double pause_s = 0.2);

  /// See Camera::next. A picture whose bytes equal the last one's is dropped: real sensors have
  /// noise, so that the camera is frozen.
  /// @throws Error after the last picture if grab has thrown, which ends grabbing
  std::optional<CameraPicture> next(double timeout_s) override;
  bool ended() const override { return false; }
  CameraMode mode() const override { return mode_; }
  bool is_live() const override { return true; }

 private:
  void run(const std::stop_token& stop);
  void grab_until(const std::stop_token& stop);
  void keep(GrabbedPicture picture);

  Grab grab_;
  CameraMode mode_;
  double pause_s_;
  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::optional<CameraPicture> newest_;  ///< not returned yet
  std::string failure_;                  ///< message of grab's exception, if any
  std::int64_t n_kept_ = 0;
  Image last_;           ///< used by the thread only
  std::jthread thread_;  ///< last member: it uses all others
};

/// Middle of the exposure on the monotonic clock.
/// @param driver_s the driver's time of the picture; used if it is within the second before
///   arrival, otherwise the time of arrival is
double capture_time_s(double driver_s, double arrival_s, double exposure_s);

/// Reads and sets a device's controls by OpenCV's property number.
struct CameraControls {
  std::function<bool(int property, double value)> set;
  std::function<double(int property)> get;
};

/// Locks exposure, focus and white balance, and records what the driver accepted.
void lock_controls(const CameraControls& controls, const CameraRequest& request, CameraMode& mode);

// Controls of a V4L2 driver that OpenCV lacks: DriverControls.cpp.

/// ioctl() of an open device: 0 if it succeeds.
using DeviceRequest = std::function<int(unsigned long request, void* argument)>;

/// Sets each control that the driver has, reads it back, and adds it to the mode's locked or
/// not_locked: gain stays where it is, the frame rate does not follow the light, the power line
/// frequency is 50 or 60 Hz; and the white balance's temperature.
void lock_driver_controls(const DeviceRequest& device, CameraMode& mode);
/// The same for a device file. Adds nothing if it cannot be opened.
void lock_driver_controls(const std::string& path, CameraMode& mode);

}  // namespace heft
