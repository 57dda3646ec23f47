// The viewpoint of a frame: projects points of the board frame to pixels through the camera's lens,
// and clips what is behind the camera, beside the frame or below the table. A lens bends straight
// edges: pieces() gives the number of parts of a long one.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>

#include "base/PoseTypes.h"
#include "base/math/Geometry.h"
#include "tracking/camera/Intrinsics.h"
#include "view/scene/Rasterizer.h"

namespace heft {

/// A corner of a flat shape, in the camera frame.
struct Corner {
  Eigen::Vector3d camera_m;
  double darkness = 0;          ///< shadows only
  unsigned hidden_by = 0;       ///< one bit for each limit of the view that it is beyond
  Eigen::Vector2d pixel{0, 0};  ///< if it is within all of them
};

class Viewpoint {
 public:
  explicit Viewpoint(const Intrinsics& camera);

  /// Moves the camera. Call before projecting.
  void place(const Pose& camera_from_board);

  Corner corner(const Eigen::Vector3d& board_m, double darkness = 0) const;

  /// The point at that height over the table that is seen at a pixel (outside the frame: at the
  /// nearest pixel of the frame); none: there is none.
  std::optional<Eigen::Vector3d> point_at_height(const Eigen::Vector2d& pixel,
                                                 double height_m) const;

  /// Whether a face with that outward normal (board frame) faces the camera.
  bool faces_camera(const Eigen::Vector3d& point_board_m, const Eigen::Vector3d& normal) const;

  /// Number of straight pieces that follow the lens's bending of an edge to 0.1 px.
  int pieces(const Eigen::Vector3d& from_board_m, const Eigen::Vector3d& to_board_m) const;

  /// Calls emit(a, b, c) with the visible corners of triangles that form a flat convex polygon of
  /// up to four corners.
  template <typename Emit>
  void triangles(std::span<const Corner> polygon, const Emit& emit) const {
    CutQuad cut;
    const std::span<const Corner> visible = clip(polygon, cut);
    for (std::size_t i = 2; i < visible.size(); ++i) emit(visible[0], visible[i - 1], visible[i]);
  }

 private:
  static constexpr std::size_t n_limits = 6;
  using CutQuad = Polygon<Corner, 4 + n_limits>;  // each limit can add one corner

  Corner seen(const Eigen::Vector3d& camera_m, double darkness) const;
  std::span<const Corner> clip(std::span<const Corner> polygon, CutQuad& cut) const;
  double within(std::size_t limit, const Eigen::Vector3d& camera_m) const;

  Intrinsics camera_;
  bool lens_bends_;
  Pose camera_from_board_;
  Eigen::Vector3d eye_board_m_ = Eigen::Vector3d::Zero();
  std::array<Eigen::Vector4d, n_limits> limits_{};  // inside: normal . point + offset >= 0
};

/// Default viewpoint without a camera: the participant's side of the table, 45 cm from the board's
/// center, which is in the middle of the frame.
Pose default_camera_from_board();

}  // namespace heft
