// The camera's intrinsics from views of the board: OpenCV's calibrateCamera over refined corners,
// from which the edge bias of each picture is taken out, and without views that don't fit the
// others. Five coefficients (k1 k2 p1 p2 k3) and both focal lengths are free: holding fx = fy and
// the tangential ones at zero costs pixels with common lenses.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/PoseTypes.h"
#include "tracking/calibration/TagViews.h"

namespace heft {

/// How a print differs from what its file says, beside its overall size, with standard errors:
/// paper that a printer stretched more in one direction, or fed askew, fits no camera from all
/// sides.
struct PrintShape {
  double stretch = 0, stretch_sd = 0;      ///< how much longer it is across than down, relatively
  double shear_rad = 0, shear_sd_rad = 0;  ///< by how much its right angles are too narrow

  bool is_stretched() const;
  bool is_sheared() const;
};

/// Which parts of the picture the board has been in: a grid of cells, each with the number of tag
/// corners in it.
struct Coverage {
  static constexpr int columns = 8, rows = 6;
  std::array<std::array<int, columns>, rows> corners{};

  void add(const TagView& view, int width_px, int height_px);
  /// Fraction of cells with any corner.
  double fraction() const;
  /// A line a row, '.' where nothing was seen, 'o' some, '#' much.
  std::string drawing() const;
  /// "the upper left", where the emptiest part is; empty where there is none.
  std::string emptiest() const;
};

struct CalibratedView {
  std::string name;
  std::size_t n_tags = 0;
  double reprojection_px = 0;        ///< rms
  Eigen::Vector3d normal{0, 0, -1};  ///< of the board, in the camera frame
  double distance_m = 0;             ///< of the board's origin
  double bias_px = 0;                ///< its edges seem moved outwards by as much
  bool used = true;                  ///< false: it does not fit the others
};

struct CameraCalibration {
  Intrinsics camera;
  double rms_px = 0;        ///< reprojection, of used views
  double focal_sd_px = 0;   ///< standard error of the focal lengths, the larger one
  double center_sd_px = 0;  ///< and of the principal point
  std::vector<CalibratedView> views;
  Coverage coverage;  ///< of used views
  PrintShape print;   ///< of a flat board

  std::size_t n_used() const;
  /// How far used views are tilted against each other: the widest angle between two board normals.
  double tilt_range_rad() const;
  /// The farthest used view's distance over the nearest one's.
  double distance_ratio() const;
};

/// Why a calibration should not be trusted and what to do about it; empty: it can be.
std::vector<std::string> doubts(const CameraCalibration& calibration);

/// How the result came about, for the top of its file.
std::string summary(const CameraCalibration& calibration);

/// The smallest number of views that a camera can be calibrated from.
inline constexpr std::size_t least_views = 5;

/// The smallest number of the board's tags that makes a picture a view of it.
inline constexpr std::size_t least_tags_of_a_view = 4;

/// Of a camera that nothing is known of: 60 degrees across, no distortion.
Intrinsics guessed_camera(int width_px, int height_px);

/// Where the board is (camera_from_board), good to some degrees and percent; none where it can't be
/// told.
std::optional<Pose> rough_pose(const MarkerBody& board, const Intrinsics& camera,
                               const TagView& view);

/// @param pictures all of one size; at least least_views with four tags or more
/// @throws Error when there are too few, or no camera fits them
CameraCalibration calibrate_camera(const MarkerBody& board, const std::vector<Image>& pictures,
                                   const std::vector<std::string>& names);

}  // namespace heft
