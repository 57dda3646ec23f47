#include "tracking/synthetic/Lens.h"

namespace heft {

Lens::Lens(const Intrinsics& camera) : camera_(camera) {
  for (const double x : {0, camera.width_px - 1})
    for (const double y : {0, camera.height_px - 1})
      widest_ray_ = std::max(widest_ray_, undistort(camera, {x, y}).norm());
  widest_ray_ *= 1.05;
}

Eigen::Vector2d Lens::pixel(const Eigen::Vector3d& point_m) const {
  const Eigen::Vector2d ray = point_m.head<2>() / point_m.z();
  const double length = ray.norm();
  if (length <= widest_ray_) return distort(camera_, ray);
  const Eigen::Vector2d beyond = ray * (1 - widest_ray_ / length);
  return distort(camera_, ray - beyond) +
         Eigen::Vector2d(camera_.fx_px * beyond.x(), camera_.fy_px * beyond.y());
}

}  // namespace heft
