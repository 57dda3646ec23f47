// The board's sheet and the effector's faces as flat quads: paper, labels, and the black cells of
// the tags' codes.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "tracking/detection/MarkerBody.h"
#include "tracking/synthetic/AreaRaster.h"

namespace heft {

/// A quadrilateral, clockwise as seen from its front, and its light relative to what is below it.
struct PrintedQuad {
  std::array<Eigen::Vector3d, 4> corners_m;
  Light light;
};

/// A flat convex part of a body. Quads follow those below them.
struct PrintedFace {
  Eigen::Vector3d center_m, normal;  ///< normal outwards
  std::vector<PrintedQuad> quads;
};

/// A white sheet on the table with a margin around the tags; empty for a board without tags.
/// @param ink_m how far ink spreads beyond the edges of black cells
/// @throws Error for an unknown family, and for tags that are not on the table
PrintedFace printed_board(const MarkerBody& board, double ink_m = 0);

/// The faces of the box, with labels around the tags.
/// @throws Error for an unknown family, and for tags that are not on a face
std::vector<PrintedFace> printed_effector(const MarkerBody& effector, double ink_m = 0);

/// Linear light reflected by a material in full light, blue, green, red.
namespace material {
inline const Eigen::Array3f paper{0.85F, 0.85F, 0.85F};
inline const Eigen::Array3f ink{0.035F, 0.035F, 0.035F};
inline const Eigen::Array3f box{0.115F, 0.075F, 0.06F};
inline const Eigen::Array3f skin{0.24F, 0.36F, 0.62F};
inline const Eigen::Array3f table{0.115F, 0.20F, 0.31F};
}  // namespace material

/// Light of a quad of that material and coverage 1.
inline Light solid(const Eigen::Array3f& color) {
  return {color[0], color[1], color[2], 1};
}

/// Light of a quad that replaces another material.
inline Light change(const Eigen::Array3f& from, const Eigen::Array3f& to) {
  const Eigen::Array3f step = to - from;
  return {step[0], step[1], step[2], 0};
}

}  // namespace heft
