// The effector's box cut open and laid flat, seen from outside, tip upwards: the four long faces
// side by side, the tip above the bottom face, the back below the top face.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "tracking/MarkerBody.h"

namespace heft {

/// A point on the flat net, meters, x right and y up; the origin is its lower left corner, flaps
/// included.
using NetPoint = Eigen::Vector2d;

/// A face on the net. None is turned: right and up of the face are right and up of the net.
struct NetFace {
  BoxFace face;
  FaceFrame frame;
  NetPoint center_m;

  NetPoint on_net(const Eigen::Vector3d& point_m) const { return center_m + frame.flat(point_m); }
  Eigen::Vector3d on_box(const NetPoint& point_m) const { return frame.at(point_m - center_m); }
  /// Upper left, upper right, lower right, lower left.
  std::array<NetPoint, 4> corners_m() const;
};

struct EffectorNet {
  std::vector<NetFace> faces;                            ///< in the order of box_faces
  std::vector<std::array<NetPoint, 2>> folds_m, cuts_m;  ///< lines
  Eigen::Vector2d size_m;

  const NetFace& at(BoxFace face) const { return faces.at(static_cast<std::size_t>(face)); }
};

EffectorNet effector_net(const Eigen::Vector3d& size_m);

/// The face that a tag is printed on.
/// @throws Error for one that lies on none
BoxFace face_of(const Eigen::Vector3d& size_m, const Tag& tag);

}  // namespace heft
