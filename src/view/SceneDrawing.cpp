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
constexpr std::array effector_face{140, 146, 150}, effector_edge{84, 88, 92};

// The filmed effector shows through its clone: where they part, both are seen.
constexpr double clone_opacity = 0.72;
constexpr double cube_shadow = 0.5, clone_shadow = 0.3;

constexpr double finger_px = 12;  // in a picture 640 pixels wide

BoxLook cube_look(int slot) {
  return {cube_face, cube_edge, 1, slot};
}

// The camera's picture, gray or in color, into one of three channels and the same size.
void copy_film(const Image& film, Image& picture) {
  if (film.width != picture.width || film.height != picture.height)
    throw Error(fmt::format(
        "a camera picture is {} x {} pixels, but its calibration is for {} x {}; calibrate the "
        "camera in the mode that it films in",
        film.width, film.height, picture.width, picture.height));
  if (film.channels == 3) {
    std::ranges::copy(film.pixels, picture.pixels.begin());
    return;
  }
  if (film.channels != 1)
    throw Error(fmt::format("a camera picture has {} channels, expected 1 (gray) or 3 (color)",
                            film.channels));
  auto* to = picture.pixels.data();
  for (const std::uint8_t gray : film.pixels) to = std::fill_n(to, 3, gray);
}
}  // namespace

struct SceneDrawing::Parts {
  Parts(const Stage& trial_stage, const Intrinsics& camera)
      : stage(trial_stage),
        viewpoint(camera),
        picture(camera.width_px, camera.height_px, 3),
        rasterizer(camera.width_px, camera.height_px) {}

  void draw_plain_table();
  void draw_background(const ViewPicture& shown);
  void draw_real_effector(const Pose& effector);
  void draw_virtual(const DisplayedFrame& frame);

  Vector3d cube_size_m() const { return Vector3d::Constant(stage.cube_size_m); }

  Stage stage;
  Viewpoint viewpoint;
  Image picture;
  Rasterizer rasterizer;
  Image plain_table;        // as seen from the viewpoint; empty: not drawn from there yet
  std::vector<Pose> cubes;  // of the last picture
};

// A table and a sheet of paper where the board would be.
void SceneDrawing::Parts::draw_plain_table() {
  constexpr std::array<std::uint8_t, 3> table{150, 168, 182};
  plain_table = picture;
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) plain_table.pixels[i] = table[i % 3];
  rasterizer.clear();
  const Vector2d a4_m(0.297, 0.210);
  draw_shadow(rasterizer, viewpoint, Pose{}, {a4_m.x(), a4_m.y(), 0}, 0.25);
  draw_sheet(rasterizer, viewpoint, a4_m, 0.002, rasterizer.add_surface({{238, 242, 244}}),
             rasterizer.add_surface({{214, 220, 224}}));
  rasterizer.paint(plain_table);
}

void SceneDrawing::Parts::draw_real_effector(const Pose& effector) {
  rasterizer.clear();
  draw_shadow(rasterizer, viewpoint, effector, stage.effector_size_m, cube_shadow);
  draw_box(rasterizer, viewpoint, effector, stage.effector_size_m,
           {effector_face, effector_edge, 1, 0});
  rasterizer.paint(picture);
}

void SceneDrawing::Parts::draw_background(const ViewPicture& shown) {
  if (shown.camera) return copy_film(*shown.camera, picture);
  if (plain_table.empty()) draw_plain_table();
  std::ranges::copy(plain_table.pixels, picture.pixels.begin());
  if (shown.frame.tracked) draw_real_effector(shown.frame.effector);
}

// Shadows first, then solid things, then the translucent one: the rasterizer's order.
void SceneDrawing::Parts::draw_virtual(const DisplayedFrame& frame) {
  rasterizer.clear();
  for (const Pose& cube : frame.cubes)
    draw_shadow(rasterizer, viewpoint, cube, cube_size_m(), cube_shadow);
  if (frame.clone)
    draw_shadow(rasterizer, viewpoint, *frame.clone, stage.effector_size_m, clone_shadow);
  int slot = 0;
  for (const Pose& cube : frame.cubes)
    draw_box(rasterizer, viewpoint, cube, cube_size_m(), cube_look(++slot));
  if (frame.clone)
    draw_box(rasterizer, viewpoint, *frame.clone, stage.effector_size_m,
             {clone_face, clone_edge, clone_opacity, 0});
  rasterizer.paint(picture);
}

SceneDrawing::SceneDrawing(const ViewSetup& setup)
    : parts_(std::make_unique<Parts>(setup.stage, setup.camera.value_or(Intrinsics{}))) {}
SceneDrawing::~SceneDrawing() = default;
SceneDrawing::SceneDrawing(SceneDrawing&&) noexcept = default;
SceneDrawing& SceneDrawing::operator=(SceneDrawing&&) noexcept = default;

const Image& SceneDrawing::draw(const ViewPicture& picture) {
  if (picture.camera_from_board) {
    parts_->viewpoint.place(*picture.camera_from_board);
    parts_->plain_table = {};
  }
  parts_->draw_background(picture);
  parts_->draw_virtual(picture.frame);
  parts_->cubes = picture.frame.cubes;
  return parts_->picture;
}

std::optional<int> SceneDrawing::slot_at(double x_px, double y_px) const {
  const double reach_px = finger_px * parts_->picture.width / 640;
  return parts_->rasterizer.find_object({x_px, y_px}, reach_px);
}

std::optional<Vector2d> SceneDrawing::label_place(int slot) const {
  if (slot < 1 || slot > static_cast<int>(parts_->cubes.size())) return {};
  // Half a cube above its top: in the picture, behind the top's far edge.
  const Pose& cube = parts_->cubes[static_cast<std::size_t>(slot - 1)];
  const Vector3d above_m(0, 0, parts_->stage.cube_size_m);
  const Corner place = parts_->viewpoint.corner(cube.position_m + above_m);
  if (place.hidden_by) return {};
  return place.pixel;
}

}  // namespace heft
