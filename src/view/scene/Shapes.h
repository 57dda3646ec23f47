// The shapes of a scene, drawn by the rasterizer for a viewpoint: boxes with flat shaded faces and
// marked edges, sheets on the table, and soft shadows.
#pragma once

#include <array>

#include "base/PoseTypes.h"
#include "view/scene/Rasterizer.h"
#include "view/scene/Viewpoint.h"

namespace heft {

/// Colors of a box: of a fully lit face and of its edges.
struct BoxLook {
  std::array<int, 3> face_bgr{}, edge_bgr{};
  double opacity = 1;
  int object = 0;  ///< for Rasterizer::find_object
};

/// Draws a box lit by the scene's one fixed lamp.
void draw_box(Rasterizer& rasterizer, const Viewpoint& viewpoint, const Pose& board_from_box,
              const Eigen::Vector3d& size_m, const BoxLook& look);

/// Draws the shadow of a box on the table: dark and sharp below a standing box, pale and wide below
/// a lifted one.
/// @param strength darkness below a standing box, 0...1
void draw_shadow(Rasterizer& rasterizer, const Viewpoint& viewpoint, const Pose& board_from_box,
                 const Eigen::Vector3d& size_m, double strength);

/// Draws a rectangle with a border on the table around the board's center.
void draw_sheet(Rasterizer& rasterizer, const Viewpoint& viewpoint, const Eigen::Vector2d& size_m,
                double border_m, std::uint8_t inside, std::uint8_t border);

}  // namespace heft
