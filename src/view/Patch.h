// A flat parallelogram with a border line along its sides: a face of a box, a sheet of paper.
#pragma once

#include <Eigen/Core>

#include "view/Rasterizer.h"
#include "view/Viewpoint.h"

namespace heft {

struct Patch {
  Eigen::Vector3d corner_m, along_m, across_m;  ///< board frame: a corner, two sides from it
  double border_m = 0;                          ///< width of the line
  int pieces = 1;                               ///< each way, so that the lens can bend it
};

/// @param inside, border surfaces of the rasterizer
void draw_patch(Rasterizer& rasterizer, const Viewpoint& viewpoint, const Patch& patch,
                std::uint8_t inside, std::uint8_t border);

}  // namespace heft
