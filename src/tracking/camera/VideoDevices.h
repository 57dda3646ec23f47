// The cameras known to Linux, and the reasons for a failure to open one.
#pragma once

#include <string>
#include <vector>

namespace heft {

struct VideoDevice {
  int number = 0;    ///< N of /dev/videoN
  std::string name;  ///< the driver's name; may be empty
};

/// Sorted by number. @param folder where device files are
std::vector<VideoDevice> video_devices(const std::string& folder = "/dev");

/// The driver's modes, one line per pixel format and size: "YUYV 640 x 480: 30, 15 pictures/s".
/// Empty for a device that is not a camera or cannot be opened.
std::vector<std::string> device_modes(const VideoDevice& device,
                                      const std::string& folder = "/dev");

/// The number in "camera:N".
/// @throws Error (usage) if it is not one
int device_number(const std::string& text);

/// @throws Error (device_missing) if the device is missing, listing the existing ones, or if this
///   user has no permission, with advice
void check_device(int number, const std::string& folder = "/dev");

/// "/dev/video0 (Logitech BRIO), /dev/video2"; "none is connected" without any.
std::string list_of(const std::vector<VideoDevice>& devices);

}  // namespace heft
