// A live camera apart from any device: how its pictures are handed on, and what its times and locks
// are worked out from.
#pragma once

#include <functional>
#include <memory>

#include "tracking/Camera.h"
#include "tracking/GrabThread.h"

namespace heft {

/// A live camera of whatever grabs its pictures: a V4L2 device, or in tests what plays one.
std::unique_ptr<Camera> live_camera(GrabThread::Grab grab, CameraMode mode);

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
