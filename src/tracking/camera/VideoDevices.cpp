#include "tracking/camera/VideoDevices.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <linux/videodev2.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
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

// V4L2 lists formats, sizes and rates by index.
template <typename Item, typename Take>
void each_listed(int file, unsigned long request, Item item, const Take& take) {
  for (item.index = 0; ioctl(file, request, &item) == 0; ++item.index) take(item);
}

std::vector<double> rates_hz(int file, const v4l2_frmsizeenum& size) {
  std::vector<double> rates;
  v4l2_frmivalenum interval{};
  interval.pixel_format = size.pixel_format;
  interval.width = size.discrete.width;
  interval.height = size.discrete.height;
  each_listed(file, VIDIOC_ENUM_FRAMEINTERVALS, interval, [&](const v4l2_frmivalenum& one) {
    if (one.type == V4L2_FRMIVAL_TYPE_DISCRETE && one.discrete.numerator > 0)
      rates.push_back(std::round(10.0 * one.discrete.denominator / one.discrete.numerator) / 10);
  });
  return rates;
}

std::string letters_of(std::uint32_t format) {
  std::string letters;
  for (int i = 0; i < 4; ++i) letters += static_cast<char>(format >> (8 * i) & 0x7f);
  return letters;
}

std::vector<std::string> modes_of(int file) {
  std::vector<std::string> modes;
  v4l2_fmtdesc format{};
  format.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  each_listed(file, VIDIOC_ENUM_FMT, format, [&](const v4l2_fmtdesc& one) {
    v4l2_frmsizeenum size{};
    size.pixel_format = one.pixelformat;
    each_listed(file, VIDIOC_ENUM_FRAMESIZES, size, [&](const v4l2_frmsizeenum& of) {
      if (of.type == V4L2_FRMSIZE_TYPE_DISCRETE)
        modes.push_back(fmt::format("{} {} x {}: {} pictures/s", letters_of(one.pixelformat),
                                    of.discrete.width, of.discrete.height,
                                    fmt::join(rates_hz(file, of), ", ")));
    });
  });
  return modes;
}
}  // namespace

std::vector<std::string> device_modes(const VideoDevice& device, const std::string& folder) {
  const std::string path = fmt::format("{}/video{}", folder, device.number);
  const int file = open(path.c_str(), O_RDWR | O_NONBLOCK);
  if (file < 0) return {};
  std::vector<std::string> modes = modes_of(file);
  close(file);
  return modes;
}

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
    throw Error(fmt::format("no permission to use the camera {}: add yourself to the group video "
                            "(sudo usermod -aG video $USER), log out and in again",
                            path),
                ExitCode::device_missing);
}

}  // namespace heft
