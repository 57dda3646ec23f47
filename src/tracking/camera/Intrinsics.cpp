#include "tracking/camera/Intrinsics.h"

#include <Eigen/LU>

namespace heft {

namespace {
// The rational model of OpenCV (calib3d, "Detailed Description"): radial gain
// (1 + k1 r2 + k2 r4 + k3 r6) / (1 + k4 r2 + k5 r4 + k6 r6) plus tangential p1, p2.
struct RadialGain {
  double value, by_r2;
};

RadialGain radial_gain(const std::array<double, 8>& d, double r2) {
  const double above = 1 + r2 * (d[0] + r2 * (d[1] + r2 * d[4]));
  const double below = 1 + r2 * (d[5] + r2 * (d[6] + r2 * d[7]));
  const double above_by_r2 = d[0] + r2 * (2 * d[1] + r2 * 3 * d[4]);
  const double below_by_r2 = d[5] + r2 * (2 * d[6] + r2 * 3 * d[7]);
  const double value = above / below;
  return {value, (above_by_r2 - value * below_by_r2) / below};
}
}  // namespace

Eigen::Vector2d project(const Intrinsics& camera, const Eigen::Vector3d& point_m) {
  return distort(camera, point_m.head<2>() / point_m.z());
}

ProjectedPoint project_with_derivative(const Intrinsics& camera, const Eigen::Vector3d& point_m) {
  const Eigen::Vector2d ray = point_m.head<2>() / point_m.z();
  const DistortedRay seen = distort_with_derivative(camera, ray);
  Eigen::Matrix<double, 2, 3> ray_by_point;
  ray_by_point << Eigen::Matrix2d::Identity(), -ray;
  return {seen.pixel, seen.pixel_by_ray * ray_by_point / point_m.z()};
}

Eigen::Vector2d distort(const Intrinsics& camera, const Eigen::Vector2d& ray) {
  return distort_with_derivative(camera, ray).pixel;
}

DistortedRay distort_with_derivative(const Intrinsics& camera, const Eigen::Vector2d& ray) {
  const double x = ray.x(), y = ray.y(), r2 = ray.squaredNorm();
  const double p1 = camera.distortion[2], p2 = camera.distortion[3];
  const RadialGain gain = radial_gain(camera.distortion, r2);
  const Eigen::Vector2d bent =
      gain.value * ray + Eigen::Vector2d(2 * p1 * x * y + p2 * (r2 + 2 * x * x),
                                         p1 * (r2 + 2 * y * y) + 2 * p2 * x * y);
  Eigen::Matrix2d bent_by_ray = 2 * gain.by_r2 * ray * ray.transpose();
  bent_by_ray.diagonal().array() += gain.value;
  bent_by_ray(0, 0) += 2 * p1 * y + 6 * p2 * x;
  bent_by_ray(0, 1) += 2 * p1 * x + 2 * p2 * y;
  bent_by_ray(1, 0) += 2 * p1 * x + 2 * p2 * y;
  bent_by_ray(1, 1) += 6 * p1 * y + 2 * p2 * x;
  const Eigen::Vector2d focal(camera.fx_px, camera.fy_px);
  return {focal.cwiseProduct(bent) + Eigen::Vector2d(camera.cx_px, camera.cy_px),
          focal.asDiagonal() * bent_by_ray};
}

Eigen::Vector2d undistort(const Intrinsics& camera, const Eigen::Vector2d& pixel) {
  return undistort(
      camera, pixel,
      {(pixel.x() - camera.cx_px) / camera.fx_px, (pixel.y() - camera.cy_px) / camera.fy_px});
}

// Newton's method: a step of 1e-7 would be followed by one of about 1e-14.
Eigen::Vector2d undistort(const Intrinsics& camera, const Eigen::Vector2d& pixel,
                          const Eigen::Vector2d& near_ray) {
  constexpr int most_steps = 20;
  constexpr double near_enough = 1e-7;
  Eigen::Vector2d ray = near_ray;
  for (int i = 0; i < most_steps; ++i) {
    const DistortedRay there = distort_with_derivative(camera, ray);
    const double determinant = there.pixel_by_ray.determinant();
    // Beyond the fold of a lens model no ray gives this pixel; returns the last one.
    if (!(determinant > 1e-6 * camera.fx_px * camera.fy_px)) break;
    const Eigen::Vector2d step = there.pixel_by_ray.inverse() * (pixel - there.pixel);
    ray += step;
    if (step.norm() < near_enough) break;
  }
  return ray;
}

Pose camera_above_board(double distance_m, double below_horizon_rad) {
  const double across = std::cos(below_horizon_rad), down = std::sin(below_horizon_rad);
  Eigen::Matrix3d rotation;  // rows: the camera's right, down and forward
  rotation << 1, 0, 0, 0, -down, -across, 0, across, -down;
  return {{0, 0, distance_m}, Eigen::Quaterniond(rotation)};
}

}  // namespace heft
