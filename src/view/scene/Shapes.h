// The few shapes that a scene is made of, drawn by the rasterizer as a viewpoint sees them: boxes
// with flat shaded faces and marked edges, sheets on the table, and the soft shadows of boxes.
#pragma once

#include <array>

#include "base/PoseTypes.h"
#include "view/scene/Rasterizer.h"
#include "view/scene/Viewpoint.h"

namespace heft {

/// How a box is painted: the color of a face that is fully lit, and of its edges.
struct BoxLook {
  std::array<int, 3> face_bgr{}, edge_bgr{};
  double opacity = 1;
  int object = 0;  ///< for Rasterizer::find_object
};

/// A box, its faces lit by the scene's one fixed lamp.
void draw_box(Rasterizer& rasterizer, const Viewpoint& viewpoint, const Pose& board_from_box,
              const Eigen::Vector3d& size_m, const BoxLook& look);

/// The shadow of a box on the table: dark and sharp where it stands, pale and wide when it hovers.
/// @param strength darkness below a box that stands, 0...1
void draw_shadow(Rasterizer& rasterizer, const Viewpoint& viewpoint, const Pose& board_from_box,
                 const Eigen::Vector3d& size_m, double strength);

/// A rectangle on the table around the board's center, with a border line.
void draw_sheet(Rasterizer& rasterizer, const Viewpoint& viewpoint, const Eigen::Vector2d& size_m,
                double border_m, std::uint8_t inside, std::uint8_t border);

}  // namespace heft
