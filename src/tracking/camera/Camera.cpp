#include "tracking/camera/Camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/Error.h"
#include "base/Names.h"

namespace heft {

namespace {
constexpr std::array table{
    CameraEntry{"camera", "a live camera: camera:0 is /dev/video0", open_live_camera},
    CameraEntry{"video", "a video file: video:session.avi", open_video_file},
    CameraEntry{"frames", "a folder of pictures: frames:pictures/", open_picture_folder},
};
}  // namespace

std::span<const CameraEntry> cameras() {
  return table;
}

CameraRequest request_for(const Intrinsics& camera, double display_rate_hz) {
  CameraRequest request;
  request.width_px = camera.width_px;
  request.height_px = camera.height_px;
  request.rate_hz = std::max(request.rate_hz, display_rate_hz);
  request.exposure_s = camera.calibrated_at.exposure_s.value_or(request.exposure_s);
  request.focus = camera.calibrated_at.focus;
  return request;
}

std::unique_ptr<Camera> open_camera(std::string_view name, const std::string& what,
                                    const CameraRequest& request) {
  const CameraEntry& entry = entry_named("camera", name, cameras());
  if (what.empty())
    throw Error(fmt::format("\"{}\" needs a source; write {}", name, entry.summary),
                ExitCode::usage);
  return entry.open(what, request);
}

}  // namespace heft
