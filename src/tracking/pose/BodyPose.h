// The pose of a body from all of its tags' edges at once. Lens distortion is taken out of the
// measured points, so that what is left is straight: the residual is the distance of a measured
// point from the line through an edge's two projected ends, brought to pixels. Unknown beside the
// pose: the edge bias, by which every black edge of a picture seems moved outwards (negative: tags
// look too small). A board of several tags tells it from its distance, since the gaps between its
// tags grow as the tags shrink; otherwise the prior holds it.
#pragma once

#include <optional>
#include <vector>

#include "base/PoseTypes.h"
#include "tracking/detection/TagEdges.h"
#include "tracking/pose/MarkerBody.h"

namespace heft {

/// A measured tag, ready for the solver.
struct TagObservation {
  struct Edge {
    Eigen::Vector3d start_m, end_m;       ///< on the body
    std::array<Eigen::Vector2d, 2> rays;  ///< two measured points, undistorted
    std::array<double, 2> px_per_ray;     ///< across the edge
    double sd_px = 0;                     ///< of each; infinite: covered, it tells nothing
  };
  std::size_t tag = 0;                       ///< its place in the body's tags
  std::array<Eigen::Vector3d, 4> corners_m;  ///< on the body
  std::array<Eigen::Vector2d, 4> rays;       ///< of the measured corners
  double px_per_ray = 0;                     ///< on average
  std::array<Edge, 4> edges;
  double dark = 0, bright = 255;    ///< stored values, means of the edges
  std::array<double, 2> blur_px{};  ///< of its upright edges, of its level ones
  double outward = 1;               ///< -1 where the detected border is white within black
  double quality = 0;
  double saturated = 0;  ///< fraction of its edges
  double area_px2 = 0;

  bool covered() const;  ///< in part: an edge tells nothing
};

TagObservation observe(const Intrinsics& camera, const Tag& tag, const MeasuredTag& measured,
                       bool bright_outside);

/// What is known of the edge bias before the body was seen.
struct BiasPrior {
  double mean_px = 0, sd_px = 0.1;  ///< sd 0: it is the mean
};

struct BodyFit {
  Pose camera_from_body;
  double bias_px = 0, bias_sd_px = 0;  ///< and its standard deviation, noise alone
  /// Of a turn about the camera's axes through the body's origin (rad), then a shift (m): what
  /// noise and the bias' uncertainty leave open.
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
  double rms_px = 0;  ///< distance of measured points from their edges
  double cost = 0;    ///< robust, in variances
  int n_tags = 0;     ///< used
  int n_faces = 0;    ///< directions that they face
  /// A second pose, far from this one, fits nearly as well: a flat body seen from afar.
  bool ambiguous = false;
  /// How far the tags' farthest corner is elsewhere in other poses that fit, near or far, squared
  /// and weighted by how likely they are beside this one.
  double spread_m2 = 0;
  /// Mean of its tags', halved where ambiguous or where their white is clipped, less where rms_px,
  /// the covariance or the spread is large.
  double quality = 0;
};

/// @param previous where the body was expected; wins where the picture can't decide
/// @return none for no tags, or where no pose fits them to a few pixels. Tags that don't fit the
///   others are left out.
std::optional<BodyFit> solve_body(const std::vector<TagObservation>& tags,
                                  const std::optional<Pose>& previous, const BiasPrior& prior);

/// How far a pose can be trusted: BodyFit's quality.
double pose_quality(const std::vector<TagObservation>& tags, const BodyFit& fit);

/// The pose and bias with the smallest robust cost near `start`, with rms_px and cost filled in.
BodyFit adjust(const std::vector<TagObservation>& tags, const Pose& start, const BiasPrior& prior);

/// Root mean square distance of a tag's measured points from its edges, pixels.
double tag_rms_px(const TagObservation& tag, const BodyFit& fit);

}  // namespace heft
