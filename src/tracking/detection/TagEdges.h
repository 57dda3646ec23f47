// Measures a tag's four edges in a picture, where a detector or a predicted pose puts them, and
// checks that it is that tag.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tracking/detection/EdgeFit.h"
#include "tracking/detection/MarkerBody.h"
#include "tracking/detection/TagFamily.h"

namespace heft {

/// The patterns of a body's tags, in their order.
/// @throws Error as tag_pattern
std::vector<TagPattern> patterns_of(const MarkerBody& body);

struct MeasuredTag {
  std::array<Eigen::Vector2d, 4> corners_px;  ///< intersections of the edges
  std::array<FittedEdge, 4> edges;            ///< clockwise, starting with the top edge
  /// Fraction of the pixels around its edges that match an edge; 0 for missing edges.
  double quality = 0;
  double saturated = 0;  ///< fraction of its edges with clipped white
  double agreement = 0;  ///< fraction of its data cells with the expected color
};

/// Settings for the measurement of a picture's edges.
struct EdgeMeasuring {
  double blur_px = 0.7;    ///< as far as known
  int most_pixels = 1000;  ///< per edge
  double noise = 0;        ///< SD of the picture's noise, gray levels; 0: unknown
  ToneCurve curve{};
  bool needs_curve_evidence = false;  ///< whether to compute FittedEdge::tone
  bool whole = false;  ///< a tag with a missing edge is not measured: its quality is 0
};

/// Hidden or missing edges keep their expected places with a large error.
/// @param corners_px expected places, within half a cell
MeasuredTag measure_tag(const Image& gray, const Intrinsics& camera, const TagPattern& pattern,
                        const std::array<Eigen::Vector2d, 4>& corners_px, const EdgeMeasuring& how);

/// The same for a tag that was just measured, in half the time: edges are fitted once, with the
/// same blur.
/// @param blur_px of its upright and of its level edges
MeasuredTag measure_tag_again(const Image& gray, const Intrinsics& camera,
                              const TagPattern& pattern,
                              const std::array<Eigen::Vector2d, 4>& corners_px,
                              const std::array<double, 2>& blur_px, const EdgeMeasuring& how);

/// For a tag that fingers partly cover: covered edges carry no information (sd_px is infinite).
/// @return none if fewer than two edges are clear, with at least that quality
std::optional<MeasuredTag> without_covered_edges(MeasuredTag tag, double least_quality);

/// The same from the detector's corners without refinement.
MeasuredTag unrefined_tag(const std::array<Eigen::Vector2d, 4>& corners_px);

}  // namespace heft
