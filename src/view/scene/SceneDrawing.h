// Draws the participant's view: the camera picture, and over it cubes with a soft contact shadow
// and the effector's clone, with correct depth between clone, cubes and table. All views share this
// rasterizer, so that a recorded video equals the displayed frames.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <vector>

#include "base/PoseTypes.h"
#include "view/ArView.h"
#include "view/scene/Rasterizer.h"
#include "view/scene/Viewpoint.h"

namespace heft {

class SceneDrawing {
 public:
  explicit SceneDrawing(const ViewSetup& setup);

  /// The displayed frame: blue, green, red, of the camera's size (640 x 480 without a camera).
  /// Valid until the next call.
  const Image& draw(const ViewFrame& shown);

  /// The slot (from 1) of the cube at a pixel of the last frame; none: no cube.
  std::optional<int> slot_at(double x_px, double y_px) const;

  /// The pixel above the middle of a cube's top in the last frame, for its label; none: not in the
  /// frame.
  std::optional<Eigen::Vector2d> label_place(int slot) const;

  /// The pixel of a point of the board frame in the last frame; none: not in it.
  std::optional<Eigen::Vector2d> pixel_of(const Eigen::Vector3d& board_m) const;

  /// The bounding box in pixels of a box of the board frame, within the frame.
  Eigen::AlignedBox2d pixels_around(const Eigen::AlignedBox3d& board_m) const;

  /// The point at that height over the table that is seen at a pixel; none: there is none.
  std::optional<Eigen::Vector3d> point_at_height(const Eigen::Vector2d& pixel,
                                                 double height_m) const {
    return viewpoint_.point_at_height(pixel, height_m);
  }

 private:
  SceneDrawing(const Stage& stage, const Intrinsics& camera);
  void draw_plain_table();
  void draw_background(const ViewFrame& shown);
  void draw_real_effector(const Pose& effector);
  void draw_virtual(const ViewFrame& shown);

  Stage stage_;
  Viewpoint viewpoint_;
  Image frame_;
  Rasterizer rasterizer_;
  Image plain_table_;        ///< as seen from the viewpoint; empty: not drawn yet
  std::vector<Pose> cubes_;  ///< of the last frame
};

// The shapes of a scene: boxes with flat shaded faces and marked edges, sheets on the table, and
// soft shadows (Shadow.cpp).

/// Colors of a box: of a fully lit face and of its edges.
struct BoxLook {
  std::array<int, 3> face_bgr{}, edge_bgr{};
  double opacity = 1;
  int object = 0;         ///< for Rasterizer::find_object
  bool outlined = false;  ///< only its edges, as wide lines
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
