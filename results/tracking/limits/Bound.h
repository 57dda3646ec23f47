// How near to the truth any tracker could come: the Cramér–Rao bound of the effector's tip. Fisher
// information of all pixels of the tags that are seen, under the picture's noise and its rounding
// to levels, where all but the effector's pose is known: light, blur, the camera and where the
// board is. So a tracker that has to find those, too, can come near to it, not below it.
#pragma once

#include <optional>

#include "tracking/synthetic/SyntheticCamera.h"

namespace heft {

class TipBound {
 public:
  using Matrix6 = Eigen::Matrix<double, 6, 6>;

  TipBound(const Apparatus& apparatus, const SyntheticSettings& settings);

  /// Variance of the tip's place, m^2, all three axes together; none where no tag is seen.
  /// @param board_from_effector standing still
  std::optional<double> tip_variance_m2(const Pose& board_from_effector);

  /// Fisher information of a turn about the camera's axes through the effector's origin (rad), then
  /// of a shift (m).
  Matrix6 information(const Pose& board_from_effector);

 private:
  Image shifted(const Pose& board_from_effector, const Eigen::Vector3d& by_m);

  Apparatus apparatus_;
  SyntheticSettings settings_;
  SyntheticCamera camera_;  ///< without noise
  double variance_;         ///< of a pixel, levels^2
};

}  // namespace heft
