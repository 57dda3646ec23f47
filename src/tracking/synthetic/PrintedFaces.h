// The board's sheet and the effector's faces as flat quads: paper, labels, and every black cell
// of the tags' true codes.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "tracking/pose/MarkerBody.h"
#include "tracking/synthetic/AreaRaster.h"

namespace heft {

/// A quadrilateral, clockwise as seen from its front, and what it adds to what it lies on.
struct PrintedQuad {
  std::array<Eigen::Vector3d, 4> corners_m;
  Light light;
};

/// A flat convex piece of a body. Patches come after what they lie on.
struct PrintedFace {
  Eigen::Vector3d center_m, normal;  ///< normal outwards
  std::vector<PrintedQuad> quads;
};

/// A white sheet on the table with a margin around the tags. Of a board without tags: nothing.
/// @throws Error for an unknown family, and for tags that don't lie on the table
PrintedFace printed_board(const MarkerBody& board);

/// The faces of the box, labels around the tags.
/// @throws Error for an unknown family, and for tags that don't lie on a face
std::vector<PrintedFace> printed_effector(const MarkerBody& effector);

/// Linear light that comes back from a material in full light, blue, green, red.
namespace material {
inline const Eigen::Array3f paper{0.85F, 0.85F, 0.85F};
inline const Eigen::Array3f ink{0.035F, 0.035F, 0.035F};
inline const Eigen::Array3f box{0.115F, 0.075F, 0.06F};
inline const Eigen::Array3f skin{0.24F, 0.36F, 0.62F};
inline const Eigen::Array3f table{0.115F, 0.20F, 0.31F};
}  // namespace material

/// What a quad of that material and coverage 1 adds to nothing.
inline Light solid(const Eigen::Array3f& color) {
  return {color[0], color[1], color[2], 1};
}

/// What a quad adds where another material was.
inline Light change(const Eigen::Array3f& from, const Eigen::Array3f& to) {
  const Eigen::Array3f step = to - from;
  return {step[0], step[1], step[2], 0};
}

}  // namespace heft
