#include "tracking/synthetic/FaceDrawing.h"

#include <cmath>

#include "base/Polygon.h"

namespace heft {

namespace {
using Eigen::Vector3d;

// Straight edges appear curved through the lens: a piece of this length is straight to 1e-4 px.
constexpr double piece_m = 0.0051;

using CutQuad = Polygon<Vector3d, 5>;  // a corner may be cut off

// The part above the table (z >= 0); corners in the board's frame.
CutQuad above_table(const CutQuad& quad_m) {
  return clipped(
      quad_m, [](const Vector3d& corner_m) { return corner_m.z(); },
      [](const Vector3d& from, const Vector3d& to, double s) -> Vector3d {
        return from + s * (to - from);
      });
}

// The outline in pixels, long edges in pieces.
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

}  // namespace heft
