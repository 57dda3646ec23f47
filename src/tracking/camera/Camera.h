// Sources of camera pictures: a V4L2 camera, a video file, a folder of images. Camera.cpp has the
// table of all. (The synthetic camera needs a hand to film, see SyntheticCamera.h.)
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/Error.h"
#include "base/Image.h"
#include "tracking/camera/Intrinsics.h"

namespace heft {

struct CameraPicture {
  Image image;  ///< 1 or 3 channels
  /// Middle of the exposure. For a live camera on the monotonic clock (base/Clock.h), for a file in
  /// seconds from its first picture.
  double capture_s = 0;
  std::int64_t number = 0;  ///< from 0; for a live camera dropped pictures count, too
  std::string name;         ///< of its file, if it has one
};

/// A picture of a file that cannot be read; the camera continues with the next one.
struct DamagedPicture : Error {
  DamagedPicture(const std::string& message, std::string of, double at_s)
      : Error(message), name(std::move(of)), capture_s(at_s) {}
  std::string name;
  double capture_s = 0;
};

/// The mode and locked settings of a camera.
struct CameraMode {
  int width_px = 0, height_px = 0;
  double rate_hz = 0;
  std::string pixel_format;         ///< "MJPG", "YUYV"...; empty if unknown
  std::vector<std::string> locked;  ///< "exposure 4 ms", "focus", "white balance"
  std::vector<std::string>
      not_locked;      ///< settings that the driver refused, each with the consequence
  CameraLocks held{};  ///< values of the locked settings
};

class Camera {
 public:
  virtual ~Camera() = default;

  /// The newest picture that was not returned yet; for a file the next one, immediately. None if
  /// there was no picture for timeout_s (a frozen or unplugged camera), or at the end of a file.
  /// @throws DamagedPicture
  virtual std::optional<CameraPicture> next(double timeout_s) = 0;

  /// Whether a file has ended.
  virtual bool ended() const = 0;

  virtual CameraMode mode() const = 0;

  /// Whether pictures arrive in real time, with capture_s on the monotonic clock.
  virtual bool is_live() const = 0;
};

/// Requested settings of a live camera; files ignore them.
struct CameraRequest {
  int width_px = 640, height_px = 480;
  double rate_hz = 30;
  double exposure_s = 0.004;
  std::optional<double> focus{};  ///< position of the lens; none: unchanged
};

/// The settings of the camera's calibration, at the display's rate or the next common one above it.
CameraRequest request_for(const Intrinsics& camera, double display_rate_hz);

/// A row of the table of cameras: "camera:N", "video:F", "frames:DIR".
struct CameraEntry {
  std::string_view name;  ///< the part before the colon
  std::string_view summary;
  std::unique_ptr<Camera> (*open)(const std::string& what, const CameraRequest& request);
};

std::span<const CameraEntry> cameras();

/// @param name of the table  @param what follows the colon of NAME:WHAT
/// @throws Error (device_missing) if the camera is missing or delivers no picture, listing existing
///   ones; Error (usage) for an unknown name; Error for a file or folder without readable pictures
std::unique_ptr<Camera> open_camera(std::string_view name, const std::string& what,
                                    const CameraRequest& request = {});

/// @param number N of /dev/videoN
std::unique_ptr<Camera> open_live_camera(const std::string& number, const CameraRequest& request);

/// Times are the file's if they increase, else picture number over rate.
std::unique_ptr<Camera> open_video_file(const std::string& path, const CameraRequest& request);

/// All pictures of a folder in natural order (frame_2 before frame_10). Times are from its
/// times.csv (columns frame, a file's name, and t_s), else 30 pictures per second.
std::unique_ptr<Camera> open_picture_folder(const std::string& path, const CameraRequest& request);

}  // namespace heft
