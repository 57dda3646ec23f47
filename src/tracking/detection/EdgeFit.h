// Where a tag's edge lies, to a hundredth of a pixel. The pixels around a predicted edge are fitted
// by what a camera makes of a straight step from black to white:
//
//   stored value = tone_curve((dark + contrast * Phi(q / blur)) * (1 + gain * u)),
//   q = d - offset - slope * u
//
// with d the pixel's distance from the predicted edge, outwards; u its place along it, -1...1; Phi
// the normal distribution function. Six unknowns, Gauss-Newton with Huber weights. Because light is
// blurred and not stored values, the tone curve no longer shrinks black tags (by .28 px an edge on
// stored values), and because residuals are of stored values, each pixel counts as much as its
// noise allows; saturated pixels don't pull.
#pragma once

#include <Eigen/Core>
#include <array>

#include "base/Image.h"
#include "tracking/detection/ToneCurve.h"

namespace heft {

/// What pixels tell about their camera's tone curve, near the one that they were fitted with. The
/// cost of a change of its bend is change^T information change - 2 rhs^T change.
struct ToneEvidence {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  ToneBend rhs = ToneBend::Zero();
  /// How far the edge that was found moves outwards with the bend, pixels.
  ToneBend outward = ToneBend::Zero();
};

/// An edge where it is expected.
struct EdgeGuess {
  Eigen::Vector2d start_px, end_px;  ///< outside is to the left of start -> end as seen on screen
  double sag_px = 0;                 ///< how far lens distortion bends the edge's middle outwards
  double cell_px = 5;                ///< width of the tag's cells across the edge
  double blur_px = 0.7;              ///< expected sd of the blur
  double blur_sd_px = 0.2;           ///< how sure that is
  bool bright_outside = true;
  double noise =
      0;  ///< sd of the picture's, gray levels, as far as that is known: no fault of edges
  ToneCurve curve{};         ///< the camera's
  bool tells_curve = false;  ///< what it says of the curve is wanted, too
};

struct FittedEdge {
  /// Two points on the edge whose errors across it are independent and have the standard deviation
  /// sd_px each: they carry all that the fit knows of the edge.
  std::array<Eigen::Vector2d, 2> points_px;
  Eigen::Vector2d start_px, end_px;  ///< the guess' ends, moved across the edge onto it
  double sd_px = 0;
  double dark = 0, bright = 0;  ///< stored values on both sides
  double blur_px = 0;
  double noise = 0;        ///< rms of what the fit leaves, gray levels
  bool saturated = false;  ///< its bright side is clipped: a less certain edge
  double quality = 0;      ///< fraction of its pixels that look like an edge; 0 without contrast
  ToneEvidence tone;       ///< where it was asked for
};

/// @param gray 1 channel  @param most_pixels rows or columns are left out of longer edges
FittedEdge fit_edge(const Image& gray, const EdgeGuess& guess, int most_pixels);

}  // namespace heft
