// The pose of a body from all of its tags' edges together. Measured points are undistorted, so that
// edges are straight: the residual is the distance of a measured point from the line through an
// edge's two projected ends, in pixels. Also unknown is the edge bias, the apparent outward
// displacement of every black edge of a picture (negative: tags look too small). A board of several
// tags distinguishes it from distance, because the gaps between its tags grow as the tags shrink;
// otherwise the prior determines it.
#pragma once

#include <optional>
#include <vector>

#include "base/PoseTypes.h"
#include "tracking/detection/MarkerBody.h"
#include "tracking/detection/TagEdges.h"

namespace heft {

/// A measured tag, prepared for the solver.
struct TagObservation {
  struct Edge {
    Eigen::Vector3d start_m, end_m;       ///< on the body
    std::array<Eigen::Vector2d, 2> rays;  ///< two measured points, undistorted
    std::array<double, 2> px_per_ray;     ///< across the edge
    double sd_px = 0;                     ///< of each point; infinite: covered
  };
  std::size_t tag = 0;                       ///< index among the body's tags
  std::array<Eigen::Vector3d, 4> corners_m;  ///< on the body
  std::array<Eigen::Vector2d, 4> rays;       ///< of the measured corners
  double px_per_ray = 0;                     ///< on average
  std::array<Edge, 4> edges;
  double dark = 0, bright = 255;    ///< stored values, means of the edges
  std::array<double, 2> blur_px{};  ///< of its upright and of its level edges
  double outward = 1;               ///< -1 where the detected border is white inside black
  double quality = 0;
  double saturated = 0;  ///< fraction of its edges with clipped white
  double area_px2 = 0;

  bool covered() const;  ///< whether an edge carries no information
  /// Distance of a measured corner from where the pose puts it; infinite behind the camera.
  double corner_off_px(std::size_t corner, const Pose& camera_from_body) const;
};

/// A measured tag as an observation for the pose search.
/// @param bright_outside whether the detected border is black inside white
TagObservation observe(const Intrinsics& camera, const Tag& tag, const MeasuredTag& measured,
                       bool bright_outside);

/// Prior knowledge of the edge bias.
struct BiasPrior {
  double mean_px = 0, sd_px = 0.1;  ///< sd 0: fixed
};

struct BodyFit {
  Pose camera_from_body;
  double bias_px = 0, bias_sd_px = 0;  ///< and its standard deviation from noise alone
  /// Of a rotation about the camera's axes through the body's origin (rad) and a shift (m), in this
  /// order, from noise and the bias's uncertainty.
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
  double rms_px = 0;  ///< distance of measured points from their edges
  double cost = 0;    ///< robust, in variances
  int n_tags = 0;     ///< number of tags used
  int n_faces = 0;    ///< number of directions that they face
  /// A distant second pose fits nearly as well: a flat body seen from afar.
  bool ambiguous = false;
  /// Displacement of the tags' farthest corner in other fitting poses, squared, weighted by their
  /// likelihood relative to this one.
  double spread_m2 = 0;
  /// Mean of its tags' quality, halved if ambiguous or if their white is clipped, lower for a large
  /// rms_px, covariance or spread.
  double quality = 0;
};

/// @param previous the expected pose; selected where the picture is ambiguous
/// @return none without tags, or if no pose fits them to a few pixels. Tags that do not fit the
///   others are left out.
std::optional<BodyFit> solve_body(const std::vector<TagObservation>& tags,
                                  const std::optional<Pose>& previous, const BiasPrior& prior);

/// Confidence in a pose: BodyFit's quality.
double pose_quality(const std::vector<TagObservation>& tags, const BodyFit& fit);

/// The pose and bias with the smallest robust cost near `start`; sets rms_px and cost.
BodyFit adjust(const std::vector<TagObservation>& tags, const Pose& start, const BiasPrior& prior);

/// How much longer the focal length is than the camera's file has it, relative to it.
struct FocalError {
  double relative = 0, sd = 0;
};
/// From the perspective of a body's edges, with its pose and bias unknown. Needs a body that is
/// large, slanted and known exactly, as a board.
FocalError focal_error(const std::vector<TagObservation>& tags, const BodyFit& fit,
                       const BiasPrior& prior);

/// Root mean square distance of a tag's measured points from its edges, pixels.
double tag_rms_px(const TagObservation& tag, const BodyFit& fit);

}  // namespace heft
