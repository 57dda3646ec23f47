// What a person with a board in front of a camera produces: views from all around it, and how far a
// camera that was calibrated from them is from the one that took them.
#pragma once

#include <string>
#include <vector>

#include "base/Random.h"
#include "tracking/synthetic/SyntheticCamera.h"

namespace heft {

/// A camera that looks at a point of the board from all sides, so that the board fills another part
/// of the picture each time: camera_from_board. @param spread 1: all around; 0: always from the
/// same side
Pose view_of_board(RandomStream& random, double spread);

struct BoardViews {
  std::vector<Image> images;
  std::vector<std::string> names;
};

/// The board alone, filmed from n sides.
BoardViews board_views(const Apparatus& apparatus, int n, double spread, std::uint64_t seed);

struct RayErrors {
  double p95_px, median_px;
};

/// How far a ray of one camera is from the same pixel's of the other, over the whole picture.
RayErrors ray_errors(const Intrinsics& found, const Intrinsics& truth);

}  // namespace heft
