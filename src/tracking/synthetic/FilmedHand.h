// A hand that holds the effector by its back end: palm, wrist, thumb and fingers as rounded cones.
// It is there to occlude and to look like skin, not to be measured: its outline is smooth and in
// perspective, its surface approximate.
#pragma once

#include <vector>

#include "tracking/synthetic/FaceDrawing.h"

namespace heft {

class FilmedHand {
 public:
  /// @param box_size_m of the effector that it holds
  explicit FilmedHand(const Eigen::Vector3d& box_size_m);

  /// The pixels that the hand reaches; empty where it comes too near to the camera to be drawn.
  PixelBox extent(const SeenBody& effector, const Lens& lens) const;

  enum class Side { behind_box, before_box };

  /// Puts that part of the hand behind what the picture holds, within its box. A point that lies
  /// outside of a face that the camera sees can't be behind the box, and all others can't be
  /// before it.
  void draw(Side side, const SeenBody& effector, const Lens& lens, LightPicture& picture) const;

 private:
  /// From one ball to another, in the effector's frame.
  struct Cone {
    Eigen::Vector3d from_m, to_m;
    double from_radius_m, to_radius_m;
  };
  /// The same in the camera's frame and in the picture.
  struct SeenCone;
  struct Surroundings;
  struct SkinInRow;

  std::vector<SeenCone> seen(const SeenBody& effector, const Lens& lens) const;

  Eigen::Vector3d half_m_;
  std::vector<Cone> cones_;
};

}  // namespace heft
