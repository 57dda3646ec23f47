// Where points of the scene appear in the picture, also a little beside it: the distortion model
// folds rays far outside back into the picture, which must not happen to what is drawn.
#pragma once

#include "tracking/Intrinsics.h"
#include "tracking/synthetic/AreaRaster.h"

namespace heft {

class Lens {
 public:
  explicit Lens(const Intrinsics& camera);

  /// Pixel of a point in the camera frame, z >= nearest_m. Exact within the picture; outside, on
  /// the right side of it.
  Eigen::Vector2d pixel(const Eigen::Vector3d& point_m) const;

  /// How many pixels a meter across is at that depth, roughly.
  double px_per_m(double z_m) const { return (camera_.fx_px + camera_.fy_px) / 2 / z_m; }

  const Intrinsics& camera() const { return camera_; }
  PixelBox picture() const { return {0, 0, camera_.width_px, camera_.height_px}; }

  /// What comes nearer than this is not drawn.
  static constexpr double nearest_m = 0.03;

 private:
  Intrinsics camera_;
  double widest_ray_ = 0;  ///< length of (x/z, y/z) up to which the model is used
};

}  // namespace heft
