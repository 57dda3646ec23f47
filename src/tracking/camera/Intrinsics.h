// A camera's projection: pinhole with OpenCV's distortion model. Camera frame: x right, y down, z
// forward. Pixel centers are integers: the top left pixel's center is (0, 0). A camera's file is in
// IntrinsicsFile.cpp.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>

#include "base/PoseTypes.h"

namespace heft {

/// What a camera's driver holds still, as far as it tells.
struct CameraLocks {
  std::optional<double> exposure_s;
  std::optional<double> focus;  ///< in the driver's own steps
};

struct Intrinsics {
  int width_px = 640, height_px = 480;
  double fx_px = 540, fy_px = 540, cx_px = 319.5, cy_px = 239.5;
  std::array<double, 8> distortion{};  ///< k1 k2 p1 p2 k3 k4 k5 k6, as OpenCV orders them
  CameraLocks calibrated_at{};         ///< what it was set to then; nothing of a file of pictures
  double readout_s = 0;  ///< how much later the last row is seen than the first: rolling shutter
  /// How its tone curve bends away from sRGB's, as ToneCurve.h counts it; none: not looked at yet.
  std::optional<std::array<double, 3>> response = std::nullopt;
};

/// A pixel and how it moves with what was projected onto it.
struct DistortedRay {
  Eigen::Vector2d pixel;
  Eigen::Matrix2d pixel_by_ray;  ///< derivative
};

/// Pixel of a point in the camera frame (z > 0), with distortion.
Eigen::Vector2d project(const Intrinsics& camera, const Eigen::Vector3d& point_m);

/// A pixel and how it moves with the point that was projected onto it.
struct ProjectedPoint {
  Eigen::Vector2d pixel;
  Eigen::Matrix<double, 2, 3> pixel_by_point;
};
ProjectedPoint project_with_derivative(const Intrinsics& camera, const Eigen::Vector3d& point_m);

/// Pixel of a ray (x/z, y/z), with distortion.
Eigen::Vector2d distort(const Intrinsics& camera, const Eigen::Vector2d& ray);
DistortedRay distort_with_derivative(const Intrinsics& camera, const Eigen::Vector2d& ray);

/// Ray (x/z, y/z) of a pixel: the inverse of distort to 1e-9, within the picture.
Eigen::Vector2d undistort(const Intrinsics& camera, const Eigen::Vector2d& pixel);
/// The same, found sooner from a ray that is near to it.
Eigen::Vector2d undistort(const Intrinsics& camera, const Eigen::Vector2d& pixel,
                          const Eigen::Vector2d& near_ray);

/// Where a camera stands on the participant's side that looks at the board's center:
/// camera_from_board. @param below_horizon_rad how steeply it looks down
Pose camera_above_board(double distance_m, double below_horizon_rad);

/// Reads OpenCV's YAML: image_width, image_height, camera_matrix, distortion_coefficients (4, 5 or
/// 8 of them); and four keys that other programs pass over and other programs' files lack:
/// exposure_s and focus, what the camera was set to, readout_s, and response.
/// @param text contents  @param file its name, for messages
/// @throws InvalidFile naming what is missing or impossible, at its line where that is known
Intrinsics parse_intrinsics(const std::string& text, const std::string& file);

/// The text of a camera file.
/// @throws Error when it can't be read, saying how such a file is made
std::string read_camera_file(const std::string& path);

/// @throws Error as read_camera_file, InvalidFile as parse_intrinsics
Intrinsics load_intrinsics(const std::string& path);

/// The YAML that parse_intrinsics and OpenCV's FileStorage read. @param comment put on top, may be
/// empty
std::string to_yaml(const Intrinsics& camera, const std::string& comment);

}  // namespace heft
