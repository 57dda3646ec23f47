// A hand that holds the effector by its back end: fingers, thumb, palm, wrist and an arm that
// enters from beyond the picture's edge, as rounded cones. It serves to occlude and to look like
// skin, not to be measured: its outline is smooth and in perspective, its surface approximate.
#pragma once

#include <vector>

#include "tracking/synthetic/FaceDrawing.h"

namespace heft {

class FilmedHand {
 public:
  /// @param box_size_m of the effector
  explicit FilmedHand(const Eigen::Vector3d& box_size_m, bool left = false);

  /// The pixels that the hand reaches; parts too near to the camera are not drawn.
  PixelBox extent(const SeenBody& effector, const Lens& lens) const;

  enum class Side { behind_box, before_box };

  /// Draws one side of the hand behind the picture's content, within its box. A point outside of a
  /// visible face cannot be behind the box, and no other point can be in front of it.
  void draw(Side side, const SeenBody& effector, const Lens& lens, LightPicture& picture) const;

 private:
  /// Between two balls, in the effector's frame.
  struct Cone {
    Eigen::Vector3d from_m, to_m;
    double from_radius_m, to_radius_m;
  };
  /// A cone in the camera's frame and in the picture.
  struct SeenCone;
  struct Surroundings;
  struct SkinInRow;

  /// One end of a cone, in the camera's frame.
  struct Ball {
    Eigen::Vector3d center_m;
    double radius_m;
  };
  static constexpr double nearest_m = 0.10;  ///< distance of drawn parts from the camera
  static Ball far_enough(const Cone& cone, const Eigen::Vector3d& from_m,
                         const Eigen::Vector3d& to_m);
  std::vector<SeenCone> seen(const SeenBody& effector, const Lens& lens) const;

  Eigen::Vector3d half_m_;
  std::vector<Cone> cones_;
};

}  // namespace heft
