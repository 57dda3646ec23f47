#include "view/SceneDrawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/Error.h"
#include "view/Rasterizer.h"
#include "view/Shapes.h"
#include "view/Viewpoint.h"

namespace heft {

namespace {
using Eigen::Vector2d;
using Eigen::Vector3d;

// Blue against yellow is the contrast that every kind of color vision keeps; neither is the white,
// black or skin of what is filmed. Blue, green, red.
constexpr std::array cube_face{52, 182, 255}, cube_edge{10, 84, 146};
constexpr std::array clone_face{228, 110, 8}, clone_edge{110, 34, 0};
constexpr std::array other_face{167, 121, 204}, other_edge{96, 52, 120};
constexpr std::array effector_face{140, 146, 150}, effector_edge{84, 88, 92};

// The filmed effector shows through its clone: where they part, both are seen.
constexpr double clone_opacity = 0.72;
constexpr double cube_shadow = 0.5, clone_shadow = 0.3;

constexpr double finger_px = 12;  // in a frame 640 pixels wide

BoxLook cube_look(int slot) {
  return {cube_face, cube_edge, 1, slot};
}

// The camera's picture, gray or in color, into one of three channels and the same size.
void copy_picture(const Image& picture, Image& frame) {
  if (picture.width != frame.width || picture.height != frame.height)
    throw Error(fmt::format(
        "a camera picture is {} x {} pixels, but its calibration is for {} x {}; calibrate the "
        "camera in the mode that it films in",
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

struct SceneDrawing::Impl {
  Impl(const Stage& trial_stage, const Intrinsics& camera)
      : stage(trial_stage),
        viewpoint(camera),
        frame(camera.width_px, camera.height_px, 3),
        rasterizer(camera.width_px, camera.height_px) {}

  void draw_plain_table();
  void draw_background(const ViewPicture& shown);
  void draw_real_effector(const Pose& effector);
  void draw_virtual(const DisplayedFrame& shown, const std::optional<Pose>& other_clone);

  Vector3d cube_size_m() const { return Vector3d::Constant(stage.cube_size_m); }

  Stage stage;
  Viewpoint viewpoint;
  Image frame;
  Rasterizer rasterizer;
  Image plain_table;        // as seen from the viewpoint; empty: not drawn from there yet
  std::vector<Pose> cubes;  // of the last frame
};

// A table and a sheet of paper where the board would be.
void SceneDrawing::Impl::draw_plain_table() {
  constexpr std::array<std::uint8_t, 3> table{150, 168, 182};
  plain_table = frame;
  for (std::size_t i = 0; i < frame.pixels.size(); ++i) plain_table.pixels[i] = table[i % 3];
  rasterizer.clear();
  const Vector2d a4_m(0.297, 0.210);
  draw_shadow(rasterizer, viewpoint, Pose{}, {a4_m.x(), a4_m.y(), 0}, 0.25);
  draw_sheet(rasterizer, viewpoint, a4_m, 0.002, rasterizer.add_surface({{238, 242, 244}}),
             rasterizer.add_surface({{214, 220, 224}}));
  rasterizer.paint(plain_table);
}

void SceneDrawing::Impl::draw_real_effector(const Pose& effector) {
  rasterizer.clear();
  draw_shadow(rasterizer, viewpoint, effector, stage.effector_size_m, cube_shadow);
  draw_box(rasterizer, viewpoint, effector, stage.effector_size_m,
           {effector_face, effector_edge, 1, 0});
  rasterizer.paint(frame);
}

void SceneDrawing::Impl::draw_background(const ViewPicture& shown) {
  if (shown.camera) return copy_picture(*shown.camera, frame);
  if (plain_table.empty()) draw_plain_table();
  std::ranges::copy(plain_table.pixels, frame.pixels.begin());
  if (shown.frame.tracked) draw_real_effector(shown.frame.effector);
}

// Shadows first, then solid things, then the translucent one: the rasterizer's order.
void SceneDrawing::Impl::draw_virtual(const DisplayedFrame& shown,
                                      const std::optional<Pose>& other_clone) {
  rasterizer.clear();
  for (const Pose& cube : shown.cubes)
    draw_shadow(rasterizer, viewpoint, cube, cube_size_m(), cube_shadow);
  if (shown.clone)
    draw_shadow(rasterizer, viewpoint, *shown.clone, stage.effector_size_m, clone_shadow);
  int slot = 0;
  for (const Pose& cube : shown.cubes)
    draw_box(rasterizer, viewpoint, cube, cube_size_m(), cube_look(++slot));
  if (shown.clone)
    draw_box(rasterizer, viewpoint, *shown.clone, stage.effector_size_m,
             {clone_face, clone_edge, clone_opacity, 0});
  if (other_clone)
    draw_box(rasterizer, viewpoint, *other_clone, stage.effector_size_m,
             {other_face, other_edge, clone_opacity, 0});
  rasterizer.paint(frame);
}

SceneDrawing::SceneDrawing(const ViewSetup& setup)
    : impl_(std::make_unique<Impl>(setup.stage, setup.camera.value_or(Intrinsics{}))) {}
SceneDrawing::~SceneDrawing() = default;
SceneDrawing::SceneDrawing(SceneDrawing&&) noexcept = default;
SceneDrawing& SceneDrawing::operator=(SceneDrawing&&) noexcept = default;

const Image& SceneDrawing::draw(const ViewPicture& shown) {
  if (shown.camera_from_board) {
    impl_->viewpoint.place(*shown.camera_from_board);
    impl_->plain_table = {};
  }
  impl_->draw_background(shown);
  impl_->draw_virtual(shown.frame, shown.other_clone);
  impl_->cubes = shown.frame.cubes;
  return impl_->frame;
}

std::optional<int> SceneDrawing::slot_at(double x_px, double y_px) const {
  const double reach_px = finger_px * impl_->frame.width / 640;
  return impl_->rasterizer.find_object({x_px, y_px}, reach_px);
}

std::optional<Vector2d> SceneDrawing::label_place(int slot) const {
  if (slot < 1 || slot > static_cast<int>(impl_->cubes.size())) return {};
  // Half a cube above its top: in the frame, behind the top's far edge.
  const Pose& cube = impl_->cubes[static_cast<std::size_t>(slot - 1)];
  const Vector3d above_m(0, 0, impl_->stage.cube_size_m);
  const Corner place = impl_->viewpoint.corner(cube.position_m + above_m);
  if (place.hidden_by) return {};
  return place.pixel;
}

}  // namespace heft
