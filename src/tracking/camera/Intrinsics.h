// A camera's projection: pinhole with OpenCV's distortion model. Camera frame: x right, y down, z
// forward. Pixel centers are integers: the top left pixel's center is (0, 0). IntrinsicsFile.cpp
// reads and writes camera files.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>

#include "base/PoseTypes.h"

namespace heft {

/// Settings that a camera's driver keeps constant, as far as it reports them.
struct CameraLocks {
  std::optional<double> exposure_s;
  std::optional<double> focus;  ///< in the driver's steps
};

struct Intrinsics {
  int width_px = 640, height_px = 480;
  double fx_px = 540, fy_px = 540, cx_px = 319.5, cy_px = 239.5;
  std::array<double, 8> distortion{};  ///< k1 k2 p1 p2 k3 k4 k5 k6, as OpenCV orders them
  CameraLocks calibrated_at{};  ///< settings during calibration; empty for pictures from files
  double readout_s = 0;         ///< delay from the first row to the last: rolling shutter
  /// Deviation of its tone curve from sRGB's, see ToneCurve.h; none: unknown.
  std::optional<std::array<double, 3>> response = std::nullopt;
};

/// A pixel and its derivative by the projected ray.
struct DistortedRay {
  Eigen::Vector2d pixel;
  Eigen::Matrix2d pixel_by_ray;  ///< derivative
};

/// Pixel of a point in the camera frame (z > 0), with distortion.
Eigen::Vector2d project(const Intrinsics& camera, const Eigen::Vector3d& point_m);

/// A pixel and its derivative by the projected point.
struct ProjectedPoint {
  Eigen::Vector2d pixel;
  Eigen::Matrix<double, 2, 3> pixel_by_point;
};
/// As project(). @param point_m in the camera frame, z > 0
ProjectedPoint project_with_derivative(const Intrinsics& camera, const Eigen::Vector3d& point_m);

/// Pixel of a ray (x/z, y/z), with distortion.
Eigen::Vector2d distort(const Intrinsics& camera, const Eigen::Vector2d& ray);
DistortedRay distort_with_derivative(const Intrinsics& camera, const Eigen::Vector2d& ray);

/// Ray (x/z, y/z) of a pixel: the inverse of distort to 1e-9, within the picture.
Eigen::Vector2d undistort(const Intrinsics& camera, const Eigen::Vector2d& pixel);
/// The same, faster, starting from a nearby ray.
Eigen::Vector2d undistort(const Intrinsics& camera, const Eigen::Vector2d& pixel,
                          const Eigen::Vector2d& near_ray);

/// Pose camera_from_board of a camera on the participant's side that looks at the board's center.
/// @param below_horizon_rad angle of its downward view
Pose camera_above_board(double distance_m, double below_horizon_rad);

/// Reads OpenCV's YAML: image_width, image_height, camera_matrix, distortion_coefficients (4, 5 or
/// 8 of them); and four optional keys that other programs ignore: exposure_s and focus (settings
/// during calibration), readout_s, and response.
/// @param text contents  @param file its name, for messages
/// @throws InvalidFile naming what is missing or invalid, with its line if known
Intrinsics parse_intrinsics(const std::string& text, const std::string& file);

/// The text of a camera file.
/// @throws Error if it cannot be read, with advice on how to make one
std::string read_camera_file(const std::string& path);

/// @throws Error as read_camera_file, InvalidFile as parse_intrinsics
Intrinsics load_intrinsics(const std::string& path);

/// YAML for parse_intrinsics and OpenCV's FileStorage. @param comment first lines, may be empty
std::string to_yaml(const Intrinsics& camera, const std::string& comment);

}  // namespace heft
