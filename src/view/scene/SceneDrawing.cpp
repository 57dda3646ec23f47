#include "view/scene/SceneDrawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/Error.h"

namespace heft {

namespace {
using Eigen::Vector2d;
using Eigen::Vector3d;

// Blue against yellow is distinct in every kind of color vision, and neither is the white, black or
// skin of the filmed scene. Blue, green, red.
constexpr std::array cube_face{52, 182, 255}, cube_edge{10, 84, 146};
constexpr std::array clone_face{228, 110, 8}, clone_edge{110, 34, 0};
constexpr std::array other_edge{200, 30, 230};  // violet
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
             {{}, other_edge, 1, 0, true});
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

namespace {
constexpr double edge_line_m = 0.0009, outline_m = 0.002;
constexpr double ambient = 0.62;  // light on a face that the lamp does not reach

// Direction to the lamp: above the table, behind the participant's left shoulder.
Vector3d to_lamp() {
  return Vector3d(-0.40, -0.48, 0.78).normalized();
}

double light_on(const Vector3d& normal) {
  return ambient + (1 - ambient) * std::max(0.0, normal.dot(to_lamp())) / to_lamp().z();
}

Surface lit(const std::array<int, 3>& bgr, double light, const BoxLook& look) {
  Surface surface{{}, look.opacity, look.object};
  for (std::size_t c = 0; c < 3; ++c)
    surface.bgr[c] = static_cast<std::uint8_t>(std::clamp(std::lround(bgr[c] * light), 0l, 255l));
  return surface;
}

// One number for the whole box, so that neighboring faces are divided alike.
int pieces_of_box(const Viewpoint& viewpoint, const Pose& board_from_box, const Vector3d& half_m) {
  int most = 1;
  for (int k = 0; k < 3; ++k) {
    for (const auto& [s, t] : {std::pair{-1, -1}, {-1, 1}, {1, -1}, {1, 1}}) {
      Vector3d from_m = half_m;
      from_m[(k + 1) % 3] *= s;
      from_m[(k + 2) % 3] *= t;
      Vector3d to_m = from_m;
      to_m[k] *= -1;
      most = std::max(most, viewpoint.pieces(board_from_box * from_m, board_from_box * to_m));
    }
  }
  return most;
}

// A flat parallelogram with a border along its sides: a face of a box, a sheet of paper.
struct BorderedQuad {
  Vector3d corner_m, along_m, across_m;  // board frame: a corner, two sides from it
  double border_m = 0;                   // width of the line
  bool hollow = false;                   // only the line
  int pieces = 1;                        // in each direction, to follow the lens distortion
};

constexpr int most_cuts = 11;  // both sides, both borders, and up to eight pieces between them

// Fractions at which a side is divided.
struct Cuts {
  std::array<double, most_cuts> at{};
  int n = 0;

  void add(double fraction) { at[static_cast<std::size_t>(n++)] = fraction; }
};

Cuts cuts(double side_m, double border_m, int pieces) {
  const double border = std::min(border_m / side_m, 0.25);
  Cuts cuts;
  cuts.add(0);
  for (int i = 0; i <= pieces; ++i) cuts.add(border + (1 - 2 * border) * i / pieces);
  cuts.add(1);
  return cuts;
}

void fill_quad(Rasterizer& rasterizer, const Viewpoint& viewpoint,
               const std::array<Corner, 4>& quad, std::uint8_t surface) {
  const auto raster = [](const Corner& corner) {
    return RasterCorner{corner.pixel, 1 / corner.camera_m.z()};
  };
  viewpoint.triangles(quad, [&](const Corner& a, const Corner& b, const Corner& c) {
    rasterizer.fill({raster(a), raster(b), raster(c)}, surface);
  });
}

void draw_quad(Rasterizer& rasterizer, const Viewpoint& viewpoint, const BorderedQuad& quad,
               std::uint8_t inside, std::uint8_t border) {
  const Cuts along = cuts(quad.along_m.norm(), quad.border_m, quad.pieces);
  const Cuts across = cuts(quad.across_m.norm(), quad.border_m, quad.pieces);
  using Row = std::array<Corner, most_cuts>;
  const auto row_at = [&](int j) {
    Row row;
    const Vector3d start_m = quad.corner_m + across.at[static_cast<std::size_t>(j)] * quad.across_m;
    for (std::size_t i = 0; i < static_cast<std::size_t>(along.n); ++i)
      row[i] = viewpoint.corner(start_m + along.at[i] * quad.along_m);
    return row;
  };
  Row lower = row_at(0);
  for (int j = 1; j < across.n; ++j) {
    const Row upper = row_at(j);
    for (std::size_t i = 1; i < static_cast<std::size_t>(along.n); ++i) {
      const bool outer = j == 1 || j == across.n - 1 || i == 1 || i + 1 == std::size_t(along.n);
      if (outer || !quad.hollow)
        fill_quad(rasterizer, viewpoint, {lower[i - 1], lower[i], upper[i], upper[i - 1]},
                  outer ? border : inside);
    }
    lower = upper;
  }
}
}  // namespace

void draw_box(Rasterizer& rasterizer, const Viewpoint& viewpoint, const Pose& board_from_box,
              const Vector3d& size_m, const BoxLook& look) {
  const Eigen::Matrix3d axes = board_from_box.orientation.toRotationMatrix();
  const int pieces = pieces_of_box(viewpoint, board_from_box, size_m / 2);
  for (int face = 0; face < 6; ++face) {
    const int k = face / 2, i = (k + 1) % 3, j = (k + 2) % 3;
    const Vector3d normal = (face % 2 ? 1 : -1) * axes.col(k);
    const Vector3d center_m = board_from_box.position_m + normal * size_m[k] / 2;
    if (!viewpoint.faces_camera(center_m, normal)) continue;
    const Vector3d along_m = axes.col(i) * size_m[i], across_m = axes.col(j) * size_m[j];
    const double light = light_on(normal);
    draw_quad(rasterizer, viewpoint,
              {center_m - (along_m + across_m) / 2, along_m, across_m,
               look.outlined ? outline_m : edge_line_m, look.outlined, pieces},
              rasterizer.add_surface(lit(look.face_bgr, light, look)),
              rasterizer.add_surface(lit(look.edge_bgr, light, look)));
  }
}

void draw_sheet(Rasterizer& rasterizer, const Viewpoint& viewpoint, const Eigen::Vector2d& size_m,
                double border_m, std::uint8_t inside, std::uint8_t border) {
  const Vector3d along_m(size_m.x(), 0, 0), across_m(0, size_m.y(), 0);
  const Vector3d corner_m = -(along_m + across_m) / 2;
  const int pieces = std::max(viewpoint.pieces(corner_m, corner_m + along_m),
                              viewpoint.pieces(corner_m, corner_m + across_m));
  draw_quad(rasterizer, viewpoint, {corner_m, along_m, across_m, border_m, false, pieces}, inside,
            border);
}

}  // namespace heft
