#include "tracking/VideoDevices.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <optional>

#include "base/Error.h"

namespace heft {

namespace {
namespace fs = std::filesystem;

std::optional<int> whole_number(std::string_view text) {
  int number = -1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size() || number < 0) return std::nullopt;
  return number;
}

std::string driver_name(int number) {
  std::ifstream file(fmt::format("/sys/class/video4linux/video{}/name", number));
  std::string name;
  std::getline(file, name);
  return name;
}
}  // namespace

std::vector<VideoDevice> video_devices(const std::string& folder) {
  constexpr std::string_view prefix = "video";
  std::vector<VideoDevice> devices;
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(prefix)) continue;
    if (const auto number = whole_number(std::string_view(name).substr(prefix.size())))
      devices.push_back({*number, driver_name(*number)});
  }
  std::ranges::sort(devices, {}, &VideoDevice::number);
  return devices;
}

int device_number(const std::string& text) {
  if (const auto number = whole_number(text)) return *number;
  throw Error(fmt::format("\"camera:{}\": expected a camera's number, as in camera:0 for "
                          "/dev/video0",
                          text),
              ExitCode::usage);
}

std::string list_of(const std::vector<VideoDevice>& devices) {
  if (devices.empty()) return "none is connected";
  std::string list;
  for (const VideoDevice& device : devices) {
    if (!list.empty()) list += ", ";
    list += fmt::format("/dev/video{}", device.number);
    if (!device.name.empty()) list += fmt::format(" ({})", device.name);
  }
  return list;
}

void check_device(int number, const std::string& folder) {
  const std::string path = fmt::format("{}/video{}", folder, number);
  if (!fs::exists(path))
    throw Error(fmt::format("there is no camera {}; cameras here: {}", path,
                            list_of(video_devices(folder))),
                ExitCode::device_missing);
  if (access(path.c_str(), R_OK | W_OK) != 0)
    throw Error(fmt::format("you may not use the camera {}: add yourself to the group video "
                            "(sudo usermod -aG video $USER), log out and in again",
                            path),
                ExitCode::device_missing);
}

}  // namespace heft
