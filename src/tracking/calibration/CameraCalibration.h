// The camera's intrinsics from views of the board: OpenCV's calibrateCamera with refined corners,
// corrected for the edge bias of each picture, without outlying views. Five coefficients (k1 k2 p1
// p2 k3) and both focal lengths are free: fx = fy and zero tangential coefficients would cost
// pixels with common lenses.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/PoseTypes.h"
#include "tracking/calibration/TagViews.h"
#include "tracking/pose/CellBias.h"

namespace heft {

/// Deviations of a print from its file, other than its overall size, with standard errors. A print
/// that was stretched in one direction, or fed askew, does not fit any camera from all sides.
struct PrintShape {
  double stretch = 0, stretch_sd = 0;      ///< relative excess of its length across over that down
  double shear_rad = 0, shear_sd_rad = 0;  ///< by how much its right angles are too narrow

  bool is_stretched() const;
  bool is_sheared() const;
};

/// How a board's tags were printed: larger or smaller than their distances, or with ink that
/// spread. Both make black squares look larger, as a camera's tone curve does. They differ in what
/// they do to a tag's cells, and by distance:
///
///                       borders                     cells
///   tone curve          the same number of pixels   the same number of pixels
///   size of the tags    in proportion to the tag    none
///   ink                 the same length             the same length
struct TagPrint {
  /// Relative excess of the tags' size over the file's, measured against their distances.
  double excess = 0, excess_sd = 0;
  double ink_m = 0, ink_sd_m = 0;  ///< by which ink spreads beyond the edges of black cells
  double bias_px = 0;              ///< mean outward displacement of the cells' edges
  double by_ink_px = 0;            ///< the part of it that ink_m explains

  bool is_off() const;
  /// Whether ink explains most of what would otherwise be attributed to the camera's tone curve.
  bool has_spread() const;
};

/// @param camera calibrated  @param pictures of the board
/// @return zeros if fewer than three pictures show enough of it
TagPrint print_of_tags(const MarkerBody& board, const Intrinsics& camera,
                       const std::vector<Image>& pictures);

/// The parts of the picture that the board has covered: a grid of cells with the number of tag
/// corners in each.
struct Coverage {
  static constexpr int columns = 8, rows = 6;
  std::array<std::array<int, columns>, rows> corners{};

  void add(const TagView& view, int width_px, int height_px);
  /// Fraction of cells with any corner.
  double fraction() const;
  /// One line per row: '.' without corners, 'o' with some, '#' with many.
  std::string drawing() const;
  /// The least covered part, as "the upper left"; empty if there is none.
  std::string emptiest() const;
};

struct CalibratedView {
  std::string name;
  std::size_t n_tags = 0;
  double reprojection_px = 0;        ///< rms
  Eigen::Vector3d normal{0, 0, -1};  ///< of the board, in the camera frame
  double distance_m = 0;             ///< of the board's origin
  double bias_px = 0;                ///< apparent outward displacement of edges
  bool used = true;                  ///< false: an outlier
};

struct CameraCalibration {
  Intrinsics camera;
  double rms_px = 0;        ///< reprojection error of used views
  double focal_sd_px = 0;   ///< standard error of the focal lengths, the larger one
  double center_sd_px = 0;  ///< standard error of the principal point
  std::vector<CalibratedView> views;
  Coverage coverage;  ///< by used views
  PrintShape print;   ///< of a flat board
  TagPrint tags;      ///< the camera is of tags with this excess, if it is_off()

  std::size_t n_used() const;
  /// The widest angle between the board normals of two used views.
  double tilt_range_rad() const;
  /// Ratio of the largest to the smallest distance of used views.
  double distance_ratio() const;
};

/// Reasons to distrust a calibration, with advice; empty if there are none.
std::vector<std::string> doubts(const CameraCalibration& calibration);

/// Description of the result, for the top of its file.
std::string summary(const CameraCalibration& calibration);

/// The last lines of a calibration's summary: "verdict: good", or "verdict: doubtful" and why.
std::string verdict_of(const std::vector<std::string>& doubts);

/// The smallest number of views for a calibration.
inline constexpr std::size_t least_views = 5;

/// The smallest number of visible board tags for a view.
inline constexpr std::size_t least_tags_of_a_view = 4;

/// A default camera: 60 degrees across, no distortion.
Intrinsics guessed_camera(int width_px, int height_px);

/// Approximate pose of the board (camera_from_board), accurate to some degrees and percent; none if
/// it cannot be determined.
std::optional<Pose> rough_pose(const MarkerBody& board, const Intrinsics& camera,
                               const TagView& view);

/// @param pictures all of one size; at least least_views with four tags or more
/// @throws Error if there are too few, or no camera fits them
CameraCalibration calibrate_camera(const MarkerBody& board, const std::vector<Image>& pictures,
                                   const std::vector<std::string>& names);

}  // namespace heft
