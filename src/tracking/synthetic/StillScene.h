// What never changes in the picture: the table and the printed board, in linear light, sharp.
#pragma once

#include "base/PoseTypes.h"
#include "tracking/MarkerBody.h"
#include "tracking/synthetic/AreaRaster.h"
#include "tracking/synthetic/Lens.h"

namespace heft {

/// @throws Error as printed_board
LightPicture still_scene(const MarkerBody& board, const Pose& camera_from_board, const Lens& lens);

}  // namespace heft
