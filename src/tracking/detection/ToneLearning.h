// Learns a camera's tone curve from pictures of the board. A wrong curve has two effects on blurred
// edges: black tags look smaller or larger than the gaps between them, and each edge's profile from
// black to white is asymmetric. Both are combined with earlier pictures' information.
#pragma once

#include "tracking/detection/EdgeFit.h"

namespace heft {

/// Sum over a picture's edges.
struct PictureTone {
  ToneEvidence sum;
  int n_edges = 0, n_saturated = 0;

  /// @param outward -1 for an edge with white inside
  void add(const FittedEdge& edge, double outward);
};

class ToneLearner {
 public:
  /// @param start initial curve: learned before, or zero, sRGB. It has no weight against pictures,
  /// and is used until they carry information.
  explicit ToneLearner(const ToneBend& start = ToneBend::Zero()) : curve_(start) {}

  const ToneCurve& curve() const { return curve_; }

  bool has_evidence() const { return !information_.isZero(); }

  /// May be repeated for the same picture while its edges move, measured with the last curve each
  /// time.
  /// @param bias_px how much larger black tags look than they are, per edge, on average
  /// @return whether edges move by so much that repeating the measurement is worth the time
  bool learn(const PictureTone& seen, double bias_px, double bias_sd_px);
  /// Ends the picture: what was learned from it stays.
  void next_picture();

 private:
  ToneCurve curve_;
  ToneBend bend_ = ToneBend::Zero();  ///< most likely; the curve's is nearer to sRGB
  // From the previous pictures, and from this one:
  ToneBend mean_ = ToneBend::Zero();
  Eigen::Matrix3d information_ = Eigen::Matrix3d::Zero(), seen_ = Eigen::Matrix3d::Zero();
};

}  // namespace heft
