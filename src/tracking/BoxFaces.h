// The six faces of the effector's box, each as a person sees it who looks at it from outside.
#pragma once

#include <Eigen/Geometry>
#include <array>

#include "base/Names.h"
#include "tracking/MarkerBody.h"

namespace heft {

/// Named as someone sees them who holds the effector level and points its tip away.
enum class BoxFace { tip, top, left, right, bottom, back };
template <>
struct EnumNames<BoxFace> {
  static constexpr std::array<std::string_view, 6> names{"tip",   "top",    "left",
                                                         "right", "bottom", "back"};
};
inline constexpr std::array<BoxFace, 6> box_faces{BoxFace::tip,   BoxFace::top,    BoxFace::left,
                                                  BoxFace::right, BoxFace::bottom, BoxFace::back};

/// A face in the effector's frame. Up is towards the tip on the four long faces, and z on the tip;
/// the back is the tip mirrored.
struct FaceFrame {
  Eigen::Vector3d center_m, right, up;  ///< right and up are unit vectors in the face's plane
  Eigen::Vector2d size_m;               ///< along right, along up

  Eigen::Vector3d normal() const { return right.cross(up); }  ///< outwards
  Eigen::Vector3d at(const Eigen::Vector2d& point_m) const {
    return center_m + point_m.x() * right + point_m.y() * up;
  }
  /// Where a point lies on the face, from its center; what sticks out of the plane is dropped.
  Eigen::Vector2d flat(const Eigen::Vector3d& point_m) const {
    return {(point_m - center_m).dot(right), (point_m - center_m).dot(up)};
  }
};

/// @param size_m length (x), width (y), height (z) of the box
FaceFrame face_frame(const Eigen::Vector3d& size_m, BoxFace face);

/// An upright square tag on a face. @param center_m from the face's center
Tag tag_on(const FaceFrame& face, int id, const Eigen::Vector2d& center_m, double side_m);

/// Out of the tag's front, of length 1.
Eigen::Vector3d tag_normal(const Tag& tag);
Eigen::Vector3d tag_center_m(const Tag& tag);
/// The tag's own frame: origin in its middle, x right, y up, z out. Its corners need not be an
/// exact square.
Pose body_from_tag(const Tag& tag);

}  // namespace heft
