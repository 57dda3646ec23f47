// A camera's tone curve, learned while it looks at the board. What blur and a wrong curve do to an
// edge tells twice: black tags look smaller or larger than the gaps between them, and each edge's
// profile from black to white is lopsided. Both are put together with what earlier pictures told.
#pragma once

#include "tracking/detection/EdgeFit.h"

namespace heft {

/// Sum over a picture's edges.
struct PictureTone {
  ToneEvidence sum;
  int n_edges = 0, n_saturated = 0;

  /// @param outward -1 for an edge whose white lies inside
  void add(const FittedEdge& edge, double outward);
};

class ToneLearner {
 public:
  /// @param start where looking for it begins: learned at another time, or zero, sRGB. It weighs
  /// nothing against what pictures tell, and is all there is while they tell nothing.
  explicit ToneLearner(const ToneBend& start = ToneBend::Zero()) : curve_(start) {}

  const ToneCurve& curve() const { return curve_; }

  bool is_told() const { return !information_.isZero(); }

  /// Once more for the same picture while its edges still move, each time measured with the last
  /// curve. @param bias_px how much larger black tags look than they are, an edge, on average
  /// @return whether edges move by so much that measuring anew is worth the time
  bool learn(const PictureTone& seen, double bias_px, double bias_sd_px);
  /// What was learned last is kept for the pictures to come.
  void next_picture();

 private:
  ToneCurve curve_;
  ToneBend bend_ = ToneBend::Zero();  ///< likeliest; the curve's is nearer to sRGB
  // Of the pictures before, and of this one.
  ToneBend mean_ = ToneBend::Zero();
  Eigen::Matrix3d information_ = Eigen::Matrix3d::Zero(), seen_ = Eigen::Matrix3d::Zero();
};

}  // namespace heft
