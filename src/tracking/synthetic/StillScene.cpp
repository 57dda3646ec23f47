#include "tracking/synthetic/StillScene.h"

#include <cmath>

#include "tracking/synthetic/FaceDrawing.h"

namespace heft {

namespace {
using Eigen::Vector3d;

const Eigen::Array3f wall{0.30F, 0.30F, 0.28F};  // where a ray passes over the table

// Rays are worked out at every so many pixels; wood does not mind the rest being interpolated.
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

void put_before_table(LightPicture& picture, const Pose& camera_from_board, const Lens& lens) {
  const Eigen::Quaterniond board_from_camera = camera_from_board.orientation.conjugate();
  const Vector3d eye_m = -(board_from_camera * camera_from_board.position_m);
  for (int y = picture.box.y0; y < picture.box.y1; ++y) {
    Light* row = picture.row(y);
    Eigen::Vector2d ray(0, 0), step(0, 0);
    for (int x = picture.box.x0; x < picture.box.x1; ++x) {
      if (x % undistorted_px == 0) {
        ray = undistort(lens.camera(), {x, y});
        step = (undistort(lens.camera(), {x + undistorted_px, y}) - ray) / undistorted_px;
      }
      row[x] = over(row[x], solid(behind_the_board(eye_m, board_from_camera * ray.homogeneous())));
      ray += step;
    }
  }
}
}  // namespace

LightPicture still_scene(const MarkerBody& board, const Pose& camera_from_board, const Lens& lens) {
  LightPicture picture(lens.picture());
  const PrintedFace sheet = printed_board(board);
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
