// Smooths the effector's measured poses and gives their velocity, without lag: a constant-velocity
// Kalman filter whose process noise adapts: low at rest, high in motion. One-Euro and other
// low-pass filters lag 20 to 58 ms at useful smoothing, which over video people would feel as mass.
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

  /// Takes in one measured pose; times increase. The first one after reset() is given back as it
  /// is, at rest.
  /// @param quality 0...1, of the measurement
  FilteredPose update(double t_s, const Pose& measured, double quality);

  /// After a jump or a loss.
  void reset();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace heft
