// The cameras that Linux knows, and why one of them can't be opened.
#pragma once

#include <string>
#include <vector>

namespace heft {

struct VideoDevice {
  int number = 0;    ///< N of /dev/videoN
  std::string name;  ///< what the driver calls it; may be empty
};

/// Sorted by number. @param folder where device files are
std::vector<VideoDevice> video_devices(const std::string& folder = "/dev");

/// What the driver offers, a line a pixel format and size: "YUYV 640 x 480: 30, 15 pictures a
/// second". Empty for what is no camera, or can't be opened.
std::vector<std::string> device_modes(const VideoDevice& device,
                                      const std::string& folder = "/dev");

/// The number in "camera:N".
/// @throws Error (usage) when it is none
int device_number(const std::string& text);

/// @throws Error (device_missing) when there is no such device, naming those that are there, or
///   when this user may not open it, saying how to change that
void check_device(int number, const std::string& folder = "/dev");

/// "/dev/video0 (Logitech BRIO), /dev/video2"; "none is connected" without any.
std::string list_of(const std::vector<VideoDevice>& devices);

}  // namespace heft
