// A rigid body with printed tags on it: the board on the table, or the effector in the hand. Board
// frame: the world's (origin at its center, z up). Effector frame: origin at its center, x along
// its length towards the tip. And the six faces of the effector's box, each as a person sees it who
// looks at it from outside.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/Names.h"
#include "tracking/camera/Intrinsics.h"

namespace heft {

/// An effector's outside: a box whose upper two long edges may be cut off, so that faces slanted at
/// 45 degrees are between its top and its sides.
struct BoxShape {
  Eigen::Vector3d size_m = Eigen::Vector3d::Zero();  ///< length (x), width (y), height (z)
  double chamfer_m = 0;                              ///< cut off the top and off each side; 0: none

  BoxShape(const Eigen::Vector3d& size, double chamfer = 0) : size_m(size), chamfer_m(chamfer) {}
};

/// Corners in the body's frame: the upright tag's top left, top right, bottom right, bottom left,
/// seen from its front; between detected corners, that is the black border's outer edge.
struct Tag {
  int id = 0;
  std::array<Eigen::Vector3d, 4> corners_m;
};

struct MarkerBody {
  std::string family = "tag36h11";
  std::vector<Tag> tags;
  /// Effector only: length, width, height of the box; zero for a board.
  Eigen::Vector3d size_m = Eigen::Vector3d::Zero();
  double chamfer_m = 0;  ///< of the box's upper long edges
  /// How long the sheet's 150 mm ruler came out of the printer; corners are already scaled by it.
  std::optional<double> measured_ruler_m;
  /// How long the sheet's other ruler came out, down it, where that was measured, too.
  std::optional<double> measured_across_m;

  BoxShape box() const { return {size_m, chamfer_m}; }
};

/// How much larger than it was designed a body's print came out, across the sheet and down it.
Eigen::Vector2d print_scale(const MarkerBody& body);

/// A body as its print came out, from how it was designed; both have the measured rulers. A board's
/// x lies across its sheet. An effector's length lies down it, and what goes round it across; its
/// ends, which close it, are as wide and as high as their neighbors, and what is on them is as it
/// was printed.
MarkerBody as_printed(const MarkerBody& designed);
/// The other way round.
MarkerBody as_designed(const MarkerBody& printed);

/// Length of the ruler line that every sheet has.
inline constexpr double ruler_m = 0.150;

/// What a camera looks at, and through what.
struct Apparatus {
  Intrinsics camera;
  MarkerBody board;
  MarkerBody effector;  ///< no tags: none is looked for
};

/// Named as someone sees them who holds the effector level and points its tip away. The last two
/// are those of a chamfered box.
enum class BoxFace { tip, top, left, right, bottom, back, upper_left, upper_right };
template <>
struct EnumNames<BoxFace> {
  static constexpr std::array<std::string_view, 8> names{
      "tip", "top", "left", "right", "bottom", "back", "upper_left", "upper_right"};
};
inline constexpr std::array<BoxFace, 8> box_faces{
    BoxFace::tip,    BoxFace::top,  BoxFace::left,       BoxFace::right,
    BoxFace::bottom, BoxFace::back, BoxFace::upper_left, BoxFace::upper_right};

/// The six that every box has, or all eight.
std::span<const BoxFace> faces_of(const BoxShape& box);

/// A face in the effector's frame. Up is towards the tip on the long faces, and z on the tip; the
/// back is the tip mirrored.
struct FaceFrame {
  Eigen::Vector3d center_m, right, up;  ///< right and up are unit vectors in the face's plane
  Eigen::Vector2d size_m;               ///< along right, along up
  double cut_m = 0;                     ///< of a chamfered box's ends: off both upper corners

  Eigen::Vector3d normal() const { return right.cross(up); }  ///< outwards
  Eigen::Vector3d at(const Eigen::Vector2d& point_m) const {
    return center_m + point_m.x() * right + point_m.y() * up;
  }
  /// Where a point lies on the face, from its center; what sticks out of the plane is dropped.
  Eigen::Vector2d flat(const Eigen::Vector3d& point_m) const {
    return {(point_m - center_m).dot(right), (point_m - center_m).dot(up)};
  }
  /// The face's corners from its center, clockwise as seen from outside, from the upper left one:
  /// four, or six of an end whose upper corners are cut.
  std::vector<Eigen::Vector2d> outline_m() const;
  /// How far a point of the face is from its nearest edge; negative outside.
  double inside_m(const Eigen::Vector2d& point_m) const;
};

/// @param face one of faces_of
FaceFrame face_frame(const BoxShape& box, BoxFace face);

/// An upright square tag on a face. @param center_m from the face's center
Tag tag_on(const FaceFrame& face, int id, const Eigen::Vector2d& center_m, double side_m);

/// Out of the tag's front, of length 1.
Eigen::Vector3d tag_normal(const Tag& tag);
Eigen::Vector3d tag_center_m(const Tag& tag);
/// The tag's own frame: origin in its middle, x right, y up, z out. Its corners need not be an
/// exact square.
Pose body_from_tag(const Tag& tag);

}  // namespace heft
