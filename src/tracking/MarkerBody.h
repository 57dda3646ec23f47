// A rigid body with printed tags on it: the board on the table, or the effector in the hand. Board
// frame: the world's (origin at its center, z up). Effector frame: origin at its center, x along
// its length towards the tip.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "tracking/Intrinsics.h"

namespace heft {

/// Corners in the body's frame: the upright tag's top left, top right, bottom right, bottom left,
/// seen from its front; between detected corners, that is the black border's outer edge.
struct Tag {
  int id = 0;
  std::array<Eigen::Vector3d, 4> corners_m;
};

struct MarkerBody {
  std::string family = "tag36h11";
  std::vector<Tag> tags;
  /// Effector only: length, width, height of the box; zero for a board.
  Eigen::Vector3d size_m = Eigen::Vector3d::Zero();
  /// How long the sheet's 150 mm ruler came out of the printer; corners are already scaled by it.
  std::optional<double> measured_ruler_m;
};

/// Length of the ruler line that every sheet has.
inline constexpr double ruler_m = 0.150;

/// What a camera looks at, and through what.
struct Apparatus {
  Intrinsics camera;
  MarkerBody board;
  MarkerBody effector;  ///< no tags: none is looked for
};

}  // namespace heft
