// The visible geometry of a trial: what anyone at the table can see and measure.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace heft {

struct Stage {
  Eigen::Vector3d effector_size_m{0.09, 0.04, 0.04};  ///< along its own x (towards the tip), y, z
  double cube_size_m = 0.035;
  std::vector<Eigen::Vector3d> slots_m;  ///< centers of the cubes' starting places, leftmost first
  double start_distance_m = 0.06;  ///< from the cubes' near faces to the resting effector's tip
  double display_rate_hz = 15;

  int n_slots() const { return static_cast<int>(slots_m.size()); }
};

}  // namespace heft
