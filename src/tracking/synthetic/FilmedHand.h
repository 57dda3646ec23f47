// A hand that holds the effector by its back end: fingers, thumb, palm, wrist and an arm that comes
// from beyond the picture's edge, as rounded cones.
// It is there to occlude and to look like skin, not to be measured: its outline is smooth and in
// perspective, its surface approximate.
#pragma once

#include <vector>

#include "tracking/synthetic/FaceDrawing.h"

namespace heft {

class FilmedHand {
 public:
  /// @param box_size_m of the effector that it holds
  explicit FilmedHand(const Eigen::Vector3d& box_size_m, bool left = false);

  /// The pixels that the hand reaches; what comes too near to the camera is not drawn.
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

  /// One end of a cone, in the camera's frame.
  struct Ball {
    Eigen::Vector3d center_m;
    double radius_m;
  };
  static constexpr double nearest_m = 0.10;  ///< to the camera that an arm is drawn
  static Ball far_enough(const Cone& cone, const Eigen::Vector3d& from_m,
                         const Eigen::Vector3d& to_m);
  std::vector<SeenCone> seen(const SeenBody& effector, const Lens& lens) const;

  Eigen::Vector3d half_m_;
  std::vector<Cone> cones_;
};

}  // namespace heft
