// The plug for where pictures come from: a V4L2 camera, a video file, a folder of images. One
// table, in Camera.cpp, names them all. (The synthetic camera needs a hand to look at:
// SyntheticCamera.h.)
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
  /// Middle of the exposure. Of a live camera: the monotonic clock (base/Clock.h); of a file:
  /// seconds from its first picture.
  double capture_s = 0;
  std::int64_t number = 0;  ///< from 0; of a live camera pictures that were never asked for count
  std::string name;         ///< of its file, where it has one
};

/// A picture of a file that can't be read; the camera goes on with the one after it.
struct DamagedPicture : Error {
  DamagedPicture(const std::string& message, std::string of, double at_s)
      : Error(message), name(std::move(of)), capture_s(at_s) {}
  std::string name;
  double capture_s = 0;
};

/// What a camera was asked to do and does.
struct CameraMode {
  int width_px = 0, height_px = 0;
  double rate_hz = 0;
  std::string pixel_format;             ///< "MJPG", "YUYV"...; empty where unknown
  std::vector<std::string> locked;      ///< "exposure 4 ms", "focus", "white balance"
  std::vector<std::string> not_locked;  ///< what the driver refused, each with what it means
  CameraLocks held{};                   ///< values of what is locked
};

class Camera {
 public:
  virtual ~Camera() = default;

  /// The newest picture that was not given yet; a file's next one, at once. None when nothing came
  /// for timeout_s (a frozen or unplugged camera) or at the end of a file.
  /// @throws DamagedPicture
  virtual std::optional<CameraPicture> next(double timeout_s) = 0;

  /// No picture will come any more: the end of a file.
  virtual bool ended() const = 0;

  virtual CameraMode mode() const = 0;

  /// Whether capture_s is the monotonic clock and pictures come when they come.
  virtual bool is_live() const = 0;
};

/// How a live camera is asked to be set; files ignore it.
struct CameraRequest {
  int width_px = 640, height_px = 480;
  double rate_hz = 30;
  double exposure_s = 0.004;
  std::optional<double> focus{};  ///< where the lens has to stand; none: where it is
};

/// What the camera was set to when it was calibrated, at the display's rate or the usual one above
/// it.
CameraRequest request_for(const Intrinsics& camera, double display_rate_hz);

/// A row of the table of cameras: "camera:N", "video:F", "frames:DIR".
struct CameraEntry {
  std::string_view name;  ///< what stands before the colon
  std::string_view summary;
  std::unique_ptr<Camera> (*open)(const std::string& what, const CameraRequest& request);
};

std::span<const CameraEntry> cameras();

/// @param name of the table  @param what follows the colon of NAME:WHAT
/// @throws Error (device_missing) when the camera is not there or gives no picture, saying what is;
///   Error (usage) for an unknown name; Error for a file or folder without readable pictures
std::unique_ptr<Camera> open_camera(std::string_view name, const std::string& what,
                                    const CameraRequest& request = {});

/// @param number N of /dev/videoN
std::unique_ptr<Camera> open_live_camera(const std::string& number, const CameraRequest& request);

/// Times are the file's own where they increase, else picture number over rate.
std::unique_ptr<Camera> open_video_file(const std::string& path, const CameraRequest& request);

/// All pictures of a folder in natural order (frame_2 before frame_10). Times from its times.csv
/// (columns frame and t_s, frame is a file's name) or 30 pictures a second.
std::unique_ptr<Camera> open_picture_folder(const std::string& path, const CameraRequest& request);

}  // namespace heft
