// An effector that nobody holds: a person drags it on the screen. The view moves it, the pictures
// of the tracker "mouse" show it where it is.
#pragma once

#include "base/PoseTypes.h"

namespace heft {

struct DraggedEffector {
  Pose pose;  ///< board frame
};

}  // namespace heft
