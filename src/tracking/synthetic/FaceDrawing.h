// Draws printed faces as the camera sees them: facing it, through the lens, lit from above, clipped
// at the table; and the static scene, the table with the board.
#pragma once

#include <optional>
#include <vector>

#include "base/PoseTypes.h"
#include "tracking/camera/Intrinsics.h"
#include "tracking/detection/MarkerBody.h"
#include "tracking/synthetic/AreaRaster.h"
#include "tracking/synthetic/PrintedFaces.h"

namespace heft {

class Lens {
 public:
  explicit Lens(const Intrinsics& camera);
  /// The same lens over fine pixels.
  Lens fine() const;

  /// Pixel of a point in the camera frame, z >= nearest_m. Exact within the picture; outside, on
  /// the correct side of it.
  Eigen::Vector2d pixel(const Eigen::Vector3d& point_m) const;

  /// Approximate scale at a depth, pixels per meter across.
  double px_per_m(double z_m) const { return (camera_.fx_px + camera_.fy_px) / 2 / z_m; }

  const Intrinsics& camera() const { return camera_; }
  PixelBox picture() const { return {0, 0, camera_.width_px, camera_.height_px}; }

  /// Nearer objects are not drawn.
  static constexpr double nearest_m = 0.03;

 private:
  Intrinsics camera_;
  double widest_ray_ = 0;  ///< length of (x/z, y/z) up to which the lens model is used
};

/// Pose of a body relative to the camera and the lamp.
struct SeenBody {
  Pose camera_from_board, board_from_body;

  Eigen::Vector3d in_camera(const Eigen::Vector3d& point_m) const {
    return camera_from_board * (board_from_body * point_m);
  }
  Eigen::Vector3d in_board(const Eigen::Vector3d& point_m) const {
    return board_from_body * point_m;
  }
};

/// A lamp above the table and ambient light.
class Shading {
 public:
  explicit Shading(const Pose& camera_from_board);

  /// Reflected light of a surface, as a factor of a quad's light; the table's is 1.
  /// @param normal in the camera's frame, of length 1
  Light on(const Eigen::Vector3f& normal) const {
    return ambient + std::max(0.0F, normal.dot(lamp_)) * direct;
  }
  const Eigen::Vector3f& towards_lamp() const { return lamp_; }

  // Fractions of ambient light and of the lamp's; coverage is not shaded.
  inline static const Light ambient{0.45F, 0.45F, 0.45F, 1};
  inline static const Light direct{0.55F, 0.55F, 0.55F, 0};

 private:
  Eigen::Vector3f lamp_;  ///< towards it, in the camera's frame; its length gives the table 1
};

/// Whether the camera is on the face's outer side.
bool is_seen(const PrintedFace& face, const SeenBody& body);

/// The pixels that the faces reach; none if they are too near to the camera.
std::optional<PixelBox> extent_of(const std::vector<PrintedFace>& faces, const SeenBody& body,
                                  const Lens& lens);

/// Adds the light of a face to the pixels that it covers. @param raster in the camera's pixels
void draw_face(const PrintedFace& face, const SeenBody& body, const Lens& lens, AreaRaster& raster);

/// @throws Error as printed_board
LightPicture still_scene(const MarkerBody& board, const Pose& camera_from_board, const Lens& lens,
                         double ink_m = 0);

}  // namespace heft
