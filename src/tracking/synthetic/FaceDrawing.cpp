#include "tracking/synthetic/FaceDrawing.h"

#include <cmath>
#include <span>
#include <vector>

#include "base/math/Geometry.h"

namespace heft {

Lens::Lens(const Intrinsics& camera) : camera_(camera) {
  for (const double x : {0, camera.width_px - 1})
    for (const double y : {0, camera.height_px - 1})
      widest_ray_ = std::max(widest_ray_, undistort(camera, {x, y}).norm());
  widest_ray_ *= 1.05;
}

Lens Lens::fine() const {
  Intrinsics fine = camera_;
  fine.width_px *= fineness;
  fine.height_px *= fineness;
  fine.fx_px *= fineness;
  fine.fy_px *= fineness;
  // Pixel centers are integers, so that a picture pixel's center is between its middle fine pixels.
  fine.cx_px = fineness * (fine.cx_px + 0.5) - 0.5;
  fine.cy_px = fineness * (fine.cy_px + 0.5) - 0.5;
  return Lens(fine);
}

Eigen::Vector2d Lens::pixel(const Eigen::Vector3d& point_m) const {
  const Eigen::Vector2d ray = point_m.head<2>() / point_m.z();
  const double length = ray.norm();
  if (length <= widest_ray_) return distort(camera_, ray);
  const Eigen::Vector2d beyond = ray * (1 - widest_ray_ / length);
  return distort(camera_, ray - beyond) +
         Eigen::Vector2d(camera_.fx_px * beyond.x(), camera_.fy_px * beyond.y());
}

namespace {
using Eigen::Vector3d;

// Straight edges are curved through the lens: a piece of this length is straight to 1e-4 px.
constexpr double piece_m = 0.0051;

using CutQuad = Polygon<Vector3d, 5>;  // one corner may be cut off

// The part above the table (z >= 0); corners in the board's frame.
CutQuad above_table(const CutQuad& quad_m) {
  return clipped(
      quad_m, [](const Vector3d& corner_m) { return corner_m.z(); },
      [](const Vector3d& from, const Vector3d& to, double s) -> Vector3d {
        return from + s * (to - from);
      });
}

// The outline in pixels, with long edges divided.
void outline(const CutQuad& corners_m, const Pose& camera_from_board, const Lens& lens,
             std::vector<Eigen::Vector2d>& outline_px) {
  outline_px.clear();
  for (std::size_t i = 0; i < corners_m.size(); ++i) {
    const Vector3d& from = corners_m[i];
    const Vector3d step = corners_m[(i + 1) % corners_m.size()] - from;
    const int n = std::max(1, static_cast<int>(std::ceil(step.norm() / piece_m)));
    for (int k = 0; k < n; ++k)
      outline_px.push_back(
          lens.pixel(camera_from_board * (from + static_cast<double>(k) / n * step)));
  }
}
}  // namespace

Shading::Shading(const Pose& camera_from_board) {
  const Vector3d towards_lamp(-0.25, 0.1, 1);
  lamp_ = (camera_from_board.orientation * towards_lamp).cast<float>();
}

bool is_seen(const PrintedFace& face, const SeenBody& body) {
  const Vector3d normal =
      body.camera_from_board.orientation * (body.board_from_body.orientation * face.normal);
  return normal.dot(body.in_camera(face.center_m)) < 0;
}

std::optional<PixelBox> extent_of(const std::vector<PrintedFace>& faces, const SeenBody& body,
                                  const Lens& lens) {
  std::vector<Eigen::Vector2d> corners_px;
  for (const PrintedFace& face : faces) {
    for (const Vector3d& corner : face.quads.front().corners_m) {
      const Vector3d in_camera = body.in_camera(corner);
      if (in_camera.z() < Lens::nearest_m) return std::nullopt;
      corners_px.push_back(lens.pixel(in_camera));
    }
  }
  return pixels_around(corners_px).grown(1);
}

void draw_face(const PrintedFace& face, const SeenBody& body, const Lens& lens,
               AreaRaster& raster) {
  std::vector<Eigen::Vector2d> outline_px;
  const Eigen::Quaterniond camera_from_body =
      body.camera_from_board.orientation * body.board_from_body.orientation;
  const Light light =
      Shading(body.camera_from_board).on((camera_from_body * face.normal).cast<float>());
  for (const PrintedQuad& quad : face.quads) {
    CutQuad corners_m;
    for (const Vector3d& corner_m : quad.corners_m) corners_m.add(body.in_board(corner_m));
    outline(above_table(corners_m), body.camera_from_board, lens, outline_px);
    raster.add(outline_px, quad.light * light);
  }
}

namespace {
using Eigen::Vector3d;

const Eigen::Array3f wall{0.30F, 0.30F, 0.28F};  // for rays that miss the table

// For the wood, rays are computed at pixels this far apart and interpolated.
constexpr int undistorted_px = 16;

// Wood: soft streaks along x, all much wider than a pixel.
float grain(double x_m, double y_m) {
  const double bend = 0.004 * std::sin(9 * x_m) + 0.002 * std::sin(31 * x_m + 1);
  const double y = y_m + bend;
  return static_cast<float>(1 + 0.10 * std::sin(170 * y) * std::sin(61 * y + 2) +
                            0.06 * std::sin(400 * y + 3 * std::sin(25 * y)));
}

Eigen::Array3f behind_the_board(const Vector3d& eye_m, const Vector3d& ray) {
  if (ray.z() > -1e-3) return wall;
  const Vector3d point_m = eye_m - eye_m.z() / ray.z() * ray;
  return material::table * grain(point_m.x(), point_m.y());
}

// One color per pixel instead of per fine pixel, because wood has no finer detail.
void draw_wood(int y, const Vector3d& eye_m, const Eigen::Quaterniond& board_from_camera,
               const Lens& lens, std::span<Light> wood) {
  Eigen::Vector2d ray(0, 0), step(0, 0);
  for (std::size_t i = 0; i < wood.size(); ++i, ray += fineness * step) {
    const int x = static_cast<int>(i) * fineness;
    if (x % undistorted_px == 0) {
      ray = undistort(lens.camera(), {x, y});
      step = (undistort(lens.camera(), {x + undistorted_px, y}) - ray) / undistorted_px;
    }
    wood[i] = solid(behind_the_board(eye_m, board_from_camera * ray.homogeneous()));
  }
}

void put_before_table(LightPicture& picture, const Pose& camera_from_board, const Lens& lens) {
  const Eigen::Quaterniond board_from_camera = camera_from_board.orientation.conjugate();
  const Vector3d eye_m = -(board_from_camera * camera_from_board.position_m);
  std::vector<Light> wood(static_cast<std::size_t>(coarse_of(picture.box).width()));
  for (int y = 0; y < picture.box.height(); ++y) {
    if (y % fineness == 0) draw_wood(y, eye_m, board_from_camera, lens, wood);
    Light* row = picture.row(y);
    for (int x = 0; x < picture.box.width(); ++x)
      row[x] = over(row[x], wood[static_cast<std::size_t>(x / fineness)]);
  }
}
}  // namespace

LightPicture still_scene(const MarkerBody& board, const Pose& camera_from_board, const Lens& lens,
                         double ink_m) {
  LightPicture picture(lens.picture());
  const PrintedFace sheet = printed_board(board, ink_m);
  const SeenBody on_table{camera_from_board, {}};
  if (!sheet.quads.empty() && is_seen(sheet, on_table)) {
    AreaRaster raster;
    raster.begin(picture.box);
    draw_face(sheet, on_table, lens, raster);
    raster.draw_behind(picture);
  }
  put_before_table(picture, camera_from_board, lens);
  return picture;
}

}  // namespace heft
