// All that a mind receives of the world: poses as drawn, a tracking flag, the time. No mass, force
// or condition.
#pragma once

#include <optional>
#include <vector>

#include "base/PoseTypes.h"

namespace heft {

struct DisplayedFrame {
  double t_s = 0;             ///< since the trial's start
  bool tracked = true;        ///< false: the effector is out of the camera's view
  Pose effector;              ///< the filmed effector; meaningless when not tracked
  std::optional<Pose> clone;  ///< absent: not drawn
  std::vector<Pose> cubes;    ///< by slot, leftmost first; empty until they appear
};

}  // namespace heft
