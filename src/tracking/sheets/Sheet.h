// Sheets to print: the board, and the effector's net. True millimeters, a ruler line to measure the
// print, and instructions on a second page.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "base/Names.h"
#include "tracking/detection/MarkerBody.h"

namespace heft {

enum class Paper { a4, letter };
template <>
struct EnumNames<Paper> {
  static constexpr std::array<std::string_view, 2> names{"a4", "letter"};
};

/// The board's tags in the middle of the sheet, portrait or landscape.
/// @param board from its file; drawn as designed, whatever ruler length was measured since
/// @throws Error if the board is larger than the paper, or not flat on the table, or the file
///   cannot be written
void write_board_sheet(const MarkerBody& board, Paper paper, const std::string& path);

/// The effector's faces with flaps, to cut out and fold.
/// @throws Error if the net is larger than the paper, a tag is on no face, or the file cannot be
/// written
void write_effector_sheet(const MarkerBody& effector, Paper paper, const std::string& path);

/// A point on the net, meters, x right and y up; the origin is its lower left corner including
/// flaps.
using NetPoint = Eigen::Vector2d;

/// A face on the net: its right and up are the net's, or both reversed.
struct NetFace {
  BoxFace face;
  FaceFrame frame;
  NetPoint center_m;
  bool upside_down = false;

  NetPoint on_net(const Eigen::Vector3d& point_m) const;
  Eigen::Vector3d on_box(const NetPoint& point_m) const;
  /// Clockwise; starts at the upper left corner of a face that is not upside down.
  std::vector<NetPoint> corners_m() const;
};

/// The net of the effector's box, seen from outside, tip upwards: the long faces side by side, the
/// tip above the bottom face, the back below the top face or, for a chamfered box, below the
/// bottom.
struct EffectorNet {
  std::vector<NetFace> faces;                            ///< each of faces_of once
  std::vector<std::array<NetPoint, 2>> folds_m, cuts_m;  ///< lines
  Eigen::Vector2d size_m;

  const NetFace& at(BoxFace face) const;
};

EffectorNet effector_net(const BoxShape& box);

/// The face with a tag.
/// @throws Error for a tag that is on no face
BoxFace face_of(const BoxShape& box, const Tag& tag);

}  // namespace heft
