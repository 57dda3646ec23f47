// Measures a tag's edge to a hundredth of a pixel. The pixels around a predicted edge are fitted by
// a camera's image of a straight step from black to white:
//
//   stored value = tone_curve((dark + contrast * Phi(q / blur)) * (1 + gain * u)),
//   q = d - offset - slope * u
//
// with d the pixel's distance from the predicted edge, outwards; u its position along it, -1...1;
// Phi the normal distribution function. Six unknowns, Gauss-Newton with Huber weights. Because blur
// acts on light, not on stored values, black tags do not shrink (as by 0.28 px per edge with stored
// values). Because residuals are of stored values, pixels have equal noise, and saturated pixels
// have no influence.
#pragma once

#include <Eigen/Core>
#include <array>

#include "base/Image.h"
#include "tracking/detection/ToneCurve.h"

namespace heft {

/// Information of pixels on their camera's tone curve, near the one used in the fit. The cost of a
/// change of its bend is change^T information change - 2 rhs^T change.
struct ToneEvidence {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  ToneBend rhs = ToneBend::Zero();
  /// Outward displacement of the fitted edge by the bend, pixels.
  ToneBend outward = ToneBend::Zero();
};

/// A predicted edge.
struct EdgeGuess {
  Eigen::Vector2d start_px, end_px;  ///< outside is to the left of start -> end as seen on screen
  double sag_px = 0;                 ///< outward bending of the edge's middle by lens distortion
  double cell_px = 5;                ///< width of the tag's cells across the edge
  double blur_px = 0.7;              ///< expected SD of the blur
  double blur_sd_px = 0.2;           ///< its standard error
  bool bright_outside = true;
  double noise =
      0;  ///< SD of the picture's noise if known, gray levels; does not lower the quality
  ToneCurve curve{};                  ///< the camera's
  bool needs_curve_evidence = false;  ///< whether to compute FittedEdge::tone
};

struct FittedEdge {
  /// Two points on the edge whose errors across it are independent with standard deviation sd_px:
  /// they contain all information of the fit on the edge.
  std::array<Eigen::Vector2d, 2> points_px;
  Eigen::Vector2d start_px, end_px;  ///< the guess's ends, moved across the edge onto it
  double sd_px = 0;
  double dark = 0, bright = 0;  ///< stored values on both sides
  double blur_px = 0;
  double noise = 0;        ///< rms residual of the fit, gray levels
  bool saturated = false;  ///< its bright side is clipped, so that it is less certain
  double quality = 0;      ///< fraction of its pixels that match an edge; 0 without contrast
  ToneEvidence tone;       ///< if required
};

/// @param gray 1 channel  @param most_pixels rows or columns are skipped on longer edges
FittedEdge fit_edge(const Image& gray, const EdgeGuess& guess, int most_pixels);

}  // namespace heft
