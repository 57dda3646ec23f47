#include "view/scene/SceneDrawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/Error.h"
#include "view/scene/Rasterizer.h"
#include "view/scene/Shapes.h"
#include "view/scene/Viewpoint.h"

namespace heft {

namespace {
using Eigen::Vector2d;
using Eigen::Vector3d;

// Blue against yellow is distinct in every kind of color vision, and neither is the white, black or
// skin of the filmed scene. Blue, green, red.
constexpr std::array cube_face{52, 182, 255}, cube_edge{10, 84, 146};
constexpr std::array clone_face{228, 110, 8}, clone_edge{110, 34, 0};
constexpr std::array other_face{167, 121, 204}, other_edge{96, 52, 120};
constexpr std::array effector_face{140, 146, 150}, effector_edge{84, 88, 92};

// The filmed effector remains visible through its clone.
constexpr double clone_opacity = 0.72;
constexpr double cube_shadow = 0.5, clone_shadow = 0.3;

constexpr double finger_px = 12;  // in a frame 640 pixels wide

BoxLook cube_look(int slot) {
  return {cube_face, cube_edge, 1, slot};
}

// The camera's picture, gray or color, as three channels of the same size.
void copy_picture(const Image& picture, Image& frame) {
  if (picture.width != frame.width || picture.height != frame.height)
    throw Error(fmt::format(
        "a camera picture has {} x {} pixels, but its calibration is for {} x {}; calibrate the "
        "camera in the mode that the session uses",
        picture.width, picture.height, frame.width, frame.height));
  if (picture.channels == 3) {
    std::ranges::copy(picture.pixels, frame.pixels.begin());
    return;
  }
  if (picture.channels != 1)
    throw Error(fmt::format("a camera picture has {} channels, expected 1 (gray) or 3 (color)",
                            picture.channels));
  auto* to = frame.pixels.data();
  for (const std::uint8_t gray : picture.pixels) to = std::fill_n(to, 3, gray);
}
}  // namespace

SceneDrawing::SceneDrawing(const ViewSetup& setup)
    : SceneDrawing(setup.stage, setup.camera.value_or(Intrinsics{})) {}

SceneDrawing::SceneDrawing(const Stage& stage, const Intrinsics& camera)
    : stage_(stage),
      viewpoint_(camera),
      frame_(camera.width_px, camera.height_px, 3),
      rasterizer_(camera.width_px, camera.height_px) {}

// A table and a sheet of paper at the board's place.
void SceneDrawing::draw_plain_table() {
  constexpr std::array<std::uint8_t, 3> table{150, 168, 182};
  plain_table_ = frame_;
  for (std::size_t i = 0; i < frame_.pixels.size(); ++i) plain_table_.pixels[i] = table[i % 3];
  rasterizer_.clear();
  const Vector2d a4_m(0.297, 0.210);
  draw_shadow(rasterizer_, viewpoint_, Pose{}, {a4_m.x(), a4_m.y(), 0}, 0.25);
  draw_sheet(rasterizer_, viewpoint_, a4_m, 0.002, rasterizer_.add_surface({{238, 242, 244}}),
             rasterizer_.add_surface({{214, 220, 224}}));
  rasterizer_.paint(plain_table_);
}

void SceneDrawing::draw_real_effector(const Pose& effector) {
  rasterizer_.clear();
  draw_shadow(rasterizer_, viewpoint_, effector, stage_.effector_size_m, cube_shadow);
  draw_box(rasterizer_, viewpoint_, effector, stage_.effector_size_m,
           {effector_face, effector_edge, 1, 0});
  rasterizer_.paint(frame_);
}

void SceneDrawing::draw_background(const ViewFrame& shown) {
  if (shown.camera) return copy_picture(*shown.camera, frame_);
  if (plain_table_.empty()) draw_plain_table();
  std::ranges::copy(plain_table_.pixels, frame_.pixels.begin());
  if (shown.frame.tracked) draw_real_effector(shown.frame.effector);
}

// In the rasterizer's order: shadows, solid objects, the translucent one.
void SceneDrawing::draw_virtual(const ViewFrame& shown) {
  const std::optional<Pose>& clone = shown.frame.clone;
  const std::vector<Pose>& cubes = shown.frame.cubes;
  rasterizer_.clear();
  const Vector3d cube_size_m = Vector3d::Constant(stage_.cube_size_m);
  for (const Pose& cube : cubes)
    draw_shadow(rasterizer_, viewpoint_, cube, cube_size_m, cube_shadow);
  if (clone) draw_shadow(rasterizer_, viewpoint_, *clone, stage_.effector_size_m, clone_shadow);
  int slot = 0;
  for (const Pose& cube : cubes)
    draw_box(rasterizer_, viewpoint_, cube, cube_size_m, cube_look(++slot));
  if (clone)
    draw_box(rasterizer_, viewpoint_, *clone, stage_.effector_size_m,
             {clone_face, clone_edge, clone_opacity, 0});
  if (shown.other_clone)
    draw_box(rasterizer_, viewpoint_, *shown.other_clone, stage_.effector_size_m,
             {other_face, other_edge, clone_opacity, 0});
  rasterizer_.paint(frame_, shown.in_front.get());
}

const Image& SceneDrawing::draw(const ViewFrame& shown) {
  if (shown.camera_from_board) {
    viewpoint_.place(*shown.camera_from_board);
    plain_table_ = {};
  }
  draw_background(shown);
  draw_virtual(shown);
  cubes_ = shown.frame.cubes;
  return frame_;
}

std::optional<int> SceneDrawing::slot_at(double x_px, double y_px) const {
  const double reach_px = finger_px * frame_.width / 640;
  return rasterizer_.find_object({x_px, y_px}, reach_px);
}

std::optional<Vector2d> SceneDrawing::pixel_of(const Vector3d& board_m) const {
  const Corner place = viewpoint_.corner(board_m);
  if (place.hidden_by) return {};
  return place.pixel;
}

Eigen::AlignedBox2d SceneDrawing::pixels_around(const Eigen::AlignedBox3d& board_m) const {
  const Eigen::AlignedBox2d frame(Vector2d::Zero(), Vector2d(frame_.width, frame_.height));
  Eigen::AlignedBox2d around;
  for (int i = 0; i < 8; ++i) {
    const auto corner = static_cast<Eigen::AlignedBox3d::CornerType>(i);
    const auto pixel = pixel_of(board_m.corner(corner));
    if (!pixel) return frame;  // it extends beyond the picture
    around.extend(*pixel + Vector2d::Constant(0.5));
  }
  return around.intersection(frame);
}

std::optional<Vector2d> SceneDrawing::label_place(int slot) const {
  if (slot < 1 || slot > static_cast<int>(cubes_.size())) return {};
  // Half a cube above its top: in the frame, behind the far edge of the top.
  const Pose& cube = cubes_[static_cast<std::size_t>(slot - 1)];
  const Vector3d above_m(0, 0, stage_.cube_size_m);
  return pixel_of(cube.position_m + above_m);
}

}  // namespace heft
