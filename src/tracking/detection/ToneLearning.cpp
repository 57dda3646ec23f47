#include "tracking/detection/ToneLearning.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "base/math/Quantiles.h"

namespace heft {

namespace {
// Typical bends: a power of 1.8 is about -0.4 of the first, a film's shoulder 1 of the second.
const ToneBend usual_bend_sd(1, 0.3, 0.3);
// Ink spread also changes the size of tags.
constexpr double least_bias_sd_px = 0.01;
// Errors of an edge's profile are not only noise.
constexpr double shape_weight = 0.5;
// Weight of earlier pictures per picture, because a camera may change its curve.
constexpr double memory = 0.97;
constexpr double worth_measuring_px = 0.01;
constexpr double most_bend = 2, most_saturated = 0.1;
}  // namespace

void PictureTone::add(const FittedEdge& edge, double outward) {
  if (edge.saturated) ++n_saturated;
  if (edge.tone.information.isZero()) return;
  sum.information += edge.tone.information;
  sum.rhs += edge.tone.rhs;
  sum.outward += outward * edge.tone.outward;
  ++n_edges;
}

bool ToneLearner::learn(const PictureTone& seen, double bias_px, double bias_sd_px) {
  // With much clipped white, only an unrepresentative part of the edges is left.
  if (seen.n_edges == 0 || most_saturated * seen.n_edges < seen.n_saturated) return false;
  const ToneBend outward = seen.sum.outward / seen.n_edges, at = curve_.bend();
  const double bias_variance = bias_sd_px * bias_sd_px + least_bias_sd_px * least_bias_sd_px;
  seen_ = shape_weight * seen.sum.information + outward * outward.transpose() / bias_variance;
  Eigen::Matrix3d before = information_;
  before.diagonal() += usual_bend_sd.cwiseAbs2().cwiseInverse();
  const ToneBend rhs = shape_weight * seen.sum.rhs - outward * bias_px / bias_variance +
                       information_ * mean_ - before * at;
  const ToneBend change = (before + seen_).ldlt().solve(rhs);
  if (!change.allFinite()) return false;
  bend_ = (at + change).cwiseMax(-most_bend).cwiseMin(most_bend);
  // Most cameras' curve is sRGB, and then the estimated bend comes from the model of edges, the
  // print, and rounding to levels.
  curve_ = ToneCurve(shrinkage_factor(outward.dot(bend_) / least_bias_sd_px) * bend_);
  return std::abs(outward.dot(curve_.bend() - at)) > worth_measuring_px;
}

void ToneLearner::next_picture() {
  if (seen_.isZero()) return;
  information_ = memory * (information_ + seen_);
  mean_ = bend_;
  seen_.setZero();
}

}  // namespace heft
