// The effector's box cut open and laid flat, seen from outside, tip upwards: the long faces side by
// side, the tip above the bottom face, the back below the top face or, of a chamfered box, below
// the bottom.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "tracking/pose/MarkerBody.h"

namespace heft {

/// A point on the flat net, meters, x right and y up; the origin is its lower left corner, flaps
/// included.
using NetPoint = Eigen::Vector2d;

/// A face on the net: its right and up are the net's, or both the other way round.
struct NetFace {
  BoxFace face;
  FaceFrame frame;
  NetPoint center_m;
  bool upside_down = false;

  NetPoint on_net(const Eigen::Vector3d& point_m) const;
  Eigen::Vector3d on_box(const NetPoint& point_m) const;
  /// Clockwise; of a face that is not upside down from its upper left one.
  std::vector<NetPoint> corners_m() const;
};

struct EffectorNet {
  std::vector<NetFace> faces;                            ///< each of faces_of once
  std::vector<std::array<NetPoint, 2>> folds_m, cuts_m;  ///< lines
  Eigen::Vector2d size_m;

  const NetFace& at(BoxFace face) const;
};

EffectorNet effector_net(const BoxShape& box);

/// The face that a tag is printed on.
/// @throws Error for one that lies on none
BoxFace face_of(const BoxShape& box, const Tag& tag);

}  // namespace heft
