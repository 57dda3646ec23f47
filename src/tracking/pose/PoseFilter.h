// Filters the effector's measured poses and estimates their velocity, without lag: a
// constant-velocity Kalman filter with adaptive process noise, low at rest and high in motion.
// One-Euro and other low-pass filters lag 20 to 58 ms at useful smoothing, which participants would
// perceive as mass over video.
#pragma once

#include <memory>

#include "base/PoseTypes.h"

namespace heft {

struct FilteredPose {
  Pose pose;
  Velocity velocity;
};

class PoseFilter {
 public:
  PoseFilter();
  ~PoseFilter();
  PoseFilter(PoseFilter&&) noexcept;
  PoseFilter& operator=(PoseFilter&&) noexcept;

  /// Processes one measured pose; times increase. The first one after reset() is returned
  /// unchanged, at rest.
  /// @param quality 0...1, of the measurement
  FilteredPose update(double t_s, const Pose& measured, double quality);

  /// Call after a jump or a loss.
  void reset();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace heft
