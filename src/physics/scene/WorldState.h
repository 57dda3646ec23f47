// The state of a simulated world at one time.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/PoseTypes.h"

namespace heft {

struct BodyState {
  Pose pose;
  Velocity velocity;
};

/// Mean force over the last step of everything that presses the clone against one cube.
struct CubeContact {
  int cube = 0;                                       ///< index into WorldState::cubes
  Eigen::Vector3d force_n = Eigen::Vector3d::Zero();  ///< on the cube, world frame
};

struct WorldState {
  bool clone_present = true;  ///< false: the effector is out of view; the clone touches nothing
  BodyState clone;
  std::vector<BodyState> cubes;
  std::vector<CubeContact> contacts;  ///< clone-cube pairs that touch, each cube at most once
};

/// 16 hexadecimal digits over the bits of every pose and velocity: equal hashes, equal bits.
std::string state_hash(const WorldState& state);

struct SolveCounts {
  long not_converged =
      0;          ///< times that velocities were taken before the solver had settled on them
  long hits = 0;  ///< of bodies: closed in at once, without duration
};

}  // namespace heft
