// A tag's four edges measured in a picture, where a detector or a predicted pose says that it is,
// and whether it really is that tag.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tracking/detection/EdgeFit.h"
#include "tracking/detection/TagFamily.h"
#include "tracking/pose/MarkerBody.h"

namespace heft {

/// One for each tag of a body, in its order.
/// @throws Error as tag_pattern
std::vector<TagPattern> patterns_of(const MarkerBody& body);

struct MeasuredTag {
  std::array<Eigen::Vector2d, 4> corners_px;  ///< where the edges meet
  std::array<FittedEdge, 4> edges;            ///< from top left to top right and on, clockwise
  /// Share of the pixels around its edges that look like an edge, 0 for edges that are not there.
  double quality = 0;
  double saturated = 0;  ///< fraction of its edges whose white is clipped
  double agreement = 0;  ///< fraction of its data cells that are black or white as they should
};

/// How a picture's edges are measured.
struct EdgeMeasuring {
  double blur_px = 0.7;    ///< as far as it is known
  int most_pixels = 1000;  ///< an edge
  double noise = 0;        ///< sd of the picture's, gray levels; 0: it is not known
  ToneCurve curve{};
  bool tells_curve = false;  ///< evidence of the curve is wanted
  bool whole = false;  ///< a tag of which an edge is not there is not measured: its quality is 0
};

/// Edges that are hidden or not there are left where they are expected, with a wide error.
/// @param corners_px where they are expected, within half a cell
MeasuredTag measure_tag(const Image& gray, const Intrinsics& camera, const TagPattern& pattern,
                        const std::array<Eigen::Vector2d, 4>& corners_px, const EdgeMeasuring& how);

/// The same where it was seen a moment ago, in half the time: edges are fitted once, as blurred as
/// they were.
/// @param blur_px of its upright edges and of its level ones, then
MeasuredTag measure_tag_again(const Image& gray, const Intrinsics& camera,
                              const TagPattern& pattern,
                              const std::array<Eigen::Vector2d, 4>& corners_px,
                              const std::array<double, 2>& blur_px, const EdgeMeasuring& how);

/// Of a tag that fingers cover in part: its covered edges tell nothing (sd_px is infinite).
/// @return none where fewer than two are clear, their quality at least so much
std::optional<MeasuredTag> without_covered_edges(MeasuredTag tag, double least_quality);

/// The same from the detector's corners as they are: each edge goes from corner to corner.
MeasuredTag unrefined_tag(const std::array<Eigen::Vector2d, 4>& corners_px);

}  // namespace heft
