// A live camera apart from any device: takes pictures as they come and keeps the newest one
// (drivers queue about four; whoever reads only when there is time sees the past), and what its
// times and locks are worked out from.
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

/// Of whatever grabs its pictures: a V4L2 device, or in tests what plays one.
class LiveCamera final : public Camera {
 public:
  /// Waits for the device's next picture. None: it gives no pictures at present, try again; it must
  /// come back within about a second, or the thread can't be ended.
  using Grab = std::function<std::optional<GrabbedPicture>()>;

  /// @param grab is called on a thread of its own only  @param pause_s after a grab without a
  /// picture
  explicit LiveCamera(Grab grab, CameraMode mode = {}, double pause_s = 0.2);

  /// As Camera::next. A picture that equals the one before it in every byte is none: real sensors
  /// have noise, so it tells that the camera is frozen.
  /// @throws Error when grab has thrown, after the last picture before: it is not asked again
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
  std::optional<CameraPicture> newest_;  ///< not given yet
  std::string failure_;                  ///< what grab has thrown, if anything
  std::int64_t n_kept_ = 0;
  Image last_;           ///< of the thread alone
  std::jthread thread_;  ///< last: it uses all others
};

/// Middle of the exposure on the monotonic clock.
/// @param driver_s when the driver says that the picture was taken; it is believed where it lies in
///   the second before arrival, else arrival counts
double capture_time_s(double driver_s, double arrival_s, double exposure_s);

/// Reads and sets a device's controls by OpenCV's number of the property.
struct CameraControls {
  std::function<bool(int property, double value)> set;
  std::function<double(int property)> get;
};

/// Fixes exposure, focus and white balance, reads back what the driver made of it, and lists it.
void lock_controls(const CameraControls& controls, const CameraRequest& request, CameraMode& mode);

}  // namespace heft
