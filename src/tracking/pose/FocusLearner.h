// Follows the focal length of a lens that refocuses and breathes, from pictures of the board.
//
// Its relative error is a random walk, estimated by a scalar Kalman filter. Most lenses are fixed,
// and one picture's estimate has errors of some 0.03 %, which would move the board by a tenth of a
// millimeter. The file's focal length is therefore used until the estimate differs from it by
// several standard errors.
#pragma once

#include <algorithm>
#include <cmath>

#include "base/math/Quantiles.h"
#include "tracking/pose/BodyPose.h"

namespace heft {

class FocusLearner {
 public:
  /// Focal length relative to the camera's file.
  double scale() const { return 1 + used_; }

  /// @param seen error of the focal length in use, from the next picture
  /// @return whether scale() has changed by so much that measuring again is worth the time
  bool learn(const FocalError& seen, double t_s) {
    if (!(seen.sd > 0 && seen.sd < useless_sd) || !(std::abs(seen.relative) < most)) return false;
    const double variance = seen.sd * seen.sd + model_sd * model_sd;
    const double passed_s = std::clamp(t_s - last_s_, 0.0, longest_s);
    last_s_ = t_s;
    variance_ = std::min(variance_ + passed_s * walk_per_s, before_variance);
    const double gain = variance_ / (variance_ + variance);
    relative_ = std::clamp(relative_ + gain * (used_ + seen.relative - relative_), -most, most);
    variance_ *= 1 - gain;
    const double sure = relative_ / (certain_sds * std::sqrt(variance_));
    const double next = shrinkage_factor(sure) * relative_;
    if (std::abs(next - used_) < worth_measuring) return false;
    used_ = next;
    return true;
  }

 private:
  static constexpr double before_variance = 0.01 * 0.01, most = 0.03, useless_sd = 0.004;
  static constexpr double model_sd = 2e-4;  // prints and edges differ slightly from their model
  static constexpr double walk_per_s = 5e-3 * 5e-3, longest_s = 1;
  static constexpr double certain_sds = 2, worth_measuring = 1e-4;

  // Relative to the camera's file: the estimate with its variance, and what is used of it.
  double relative_ = 0, variance_ = before_variance, used_ = 0;
  double last_s_ = 0;  ///< time of the last picture
};

}  // namespace heft
