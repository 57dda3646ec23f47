// The net of the effector's box, seen from outside, tip upwards: the long faces side by side, the
// tip above the bottom face, the back below the top face or, for a chamfered box, below the bottom.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "tracking/pose/MarkerBody.h"

namespace heft {

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
