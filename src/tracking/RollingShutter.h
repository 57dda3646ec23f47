// A rolling shutter reads its rows one after the other: row r of R at t + readout * r / R, t being
// the picture's capture time. What moves meanwhile leans, shears and stretches, by millimeters.
#pragma once

#include <vector>

#include "base/PoseTypes.h"
#include "tracking/BodyPose.h"

namespace heft {

/// How long after the first row the one through the body's origin is read, seconds.
double own_row_s(const Intrinsics& camera, const Pose& camera_from_body);

/// What was measured of a moving body, as if all of it had been seen when its own row was read:
/// each point goes back by the way that its part of the body has moved since.
/// @param camera_from_body good to some millimeters
/// @param velocity of the body's origin, in the camera's frame; steady while the body's rows are
/// read
std::vector<TagObservation> held_still(std::vector<TagObservation> tags, const Intrinsics& camera,
                                       const Pose& camera_from_body, const Velocity& velocity);

}  // namespace heft
