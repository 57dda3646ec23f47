// A rigid body with printed tags: the board on the table, or the effector in the hand. Board frame:
// the world's (origin at its center, z up). Effector frame: origin at its center, x along its
// length towards the tip. Also the faces of the effector's box, as seen from outside.
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

/// An effector's shape: a box whose upper two long edges may be cut off, with faces slanted at 45
/// degrees between its top and its sides.
struct BoxShape {
  Eigen::Vector3d size_m = Eigen::Vector3d::Zero();  ///< length (x), width (y), height (z)
  double chamfer_m = 0;                              ///< cut off the top and each side; 0: none

  BoxShape(const Eigen::Vector3d& size, double chamfer = 0) : size_m(size), chamfer_m(chamfer) {}
};

/// Corners in the body's frame: the upright tag's top left, top right, bottom right, bottom left,
/// seen from its front. Detected corners are those of the black border's outer edge.
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
  /// Measured length of the sheet's 150 mm ruler; corners are already scaled by it.
  std::optional<double> measured_ruler_m;
  /// Measured length of the sheet's other ruler, down the sheet, if it was measured.
  std::optional<double> measured_across_m;

  BoxShape box() const { return {size_m, chamfer_m}; }
};

/// Ratio of a body's printed to its designed size, across and down the sheet.
Eigen::Vector2d print_scale(const MarkerBody& body);

/// The printed body from the designed one; both have the measured rulers. A board's x is across its
/// sheet. An effector's length is down its sheet, its circumference across. Its ends keep the width
/// and height of their neighbors, and their tags the printed size.
MarkerBody as_printed(const MarkerBody& designed);
/// The inverse of as_printed.
MarkerBody as_designed(const MarkerBody& printed);

/// Designed length of every sheet's ruler line.
inline constexpr double ruler_m = 0.150;

/// Camera, board and effector.
struct Apparatus {
  Intrinsics camera;
  MarkerBody board;
  MarkerBody effector;  ///< without tags it is not tracked
};

/// Named for a person who holds the effector level with its tip pointing away. The last two belong
/// to a chamfered box.
enum class BoxFace { tip, top, left, right, bottom, back, upper_left, upper_right };
template <>
struct EnumNames<BoxFace> {
  static constexpr std::array<std::string_view, 8> names{
      "tip", "top", "left", "right", "bottom", "back", "upper_left", "upper_right"};
};
inline constexpr std::array<BoxFace, 8> box_faces{
    BoxFace::tip,    BoxFace::top,  BoxFace::left,       BoxFace::right,
    BoxFace::bottom, BoxFace::back, BoxFace::upper_left, BoxFace::upper_right};

/// Six faces, or eight of a chamfered box.
std::span<const BoxFace> faces_of(const BoxShape& box);

/// A face in the effector's frame. On long faces up is towards the tip, on the tip it is z; the
/// back is the tip mirrored.
struct FaceFrame {
  Eigen::Vector3d center_m, right, up;  ///< right and up are unit vectors in the face's plane
  Eigen::Vector2d size_m;               ///< along right and up
  double cut_m = 0;  ///< for a chamfered box's ends: both upper corners are cut by this length

  Eigen::Vector3d normal() const;  ///< outwards
  Eigen::Vector3d at(const Eigen::Vector2d& point_m) const;
  /// Projection of a point onto the face, relative to its center.
  Eigen::Vector2d flat(const Eigen::Vector3d& point_m) const;
  /// The face's corners relative to its center, clockwise as seen from outside, starting with the
  /// upper left one: four, or six for an end with cut corners.
  std::vector<Eigen::Vector2d> outline_m() const;
  /// Distance of a point of the face from its nearest edge; negative outside.
  double inside_m(const Eigen::Vector2d& point_m) const;
};

/// @param face one of faces_of
FaceFrame face_frame(const BoxShape& box, BoxFace face);

/// An upright square tag on a face. @param center_m relative to the face's center
Tag tag_on(const FaceFrame& face, int id, const Eigen::Vector2d& center_m, double side_m);

/// Unit vector out of the tag's front.
Eigen::Vector3d tag_normal(const Tag& tag);
Eigen::Vector3d tag_center_m(const Tag& tag);
/// The body with tags of another size, at the same places.
MarkerBody with_scaled_tags(MarkerBody body, double scale);
/// The tag's frame: origin in its middle, x right, y up, z out. Its corners need not form an exact
/// square.
Pose body_from_tag(const Tag& tag);

}  // namespace heft
