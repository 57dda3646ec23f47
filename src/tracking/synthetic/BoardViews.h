// Simulates a person holding a board in front of a camera: views from all sides, and the difference
// between the camera calibrated from them and the true one.
#pragma once

#include <string>
#include <vector>

#include "base/Random.h"
#include "tracking/synthetic/SyntheticCamera.h"

namespace heft {

/// A pose camera_from_board from a random side, so that the board covers different parts of the
/// picture.
/// @param spread 1: all around; 0: always from the same side
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

/// Angles between the rays of equal pixels of two cameras, over the whole picture.
RayErrors ray_errors(const Intrinsics& found, const Intrinsics& truth);

}  // namespace heft
