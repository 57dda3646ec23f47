#include "tracking/synthetic/BoardViews.h"

#include <cmath>

#include "base/math/Quantiles.h"

namespace heft {

Pose view_of_board(RandomStream& random, double spread) {
  const auto within = [&](double half) { return half * (2 * random.uniform() - 1); };
  const double around = within(M_PI) * spread, tilt = 0.15 + 0.65 * random.uniform() * spread;
  const double distance_m = 0.36 + 0.14 * random.uniform();
  const Eigen::Vector3d seen_m(within(0.10), within(0.08), 0);
  const Eigen::Vector3d back(std::sin(tilt) * std::cos(around), std::sin(tilt) * std::sin(around),
                             std::cos(tilt));
  const Eigen::Vector3d z = -back;
  const double roll = within(0.5);
  const Eigen::Vector3d hint(std::cos(roll), std::sin(roll), 0);
  const Eigen::Vector3d y = z.cross(hint).normalized(), x = y.cross(z);
  Eigen::Matrix3d camera_from_board;
  camera_from_board << x.transpose(), y.transpose(), z.transpose();
  const Eigen::Vector3d eye_m = seen_m + distance_m * back;
  return {-(camera_from_board * eye_m), Eigen::Quaterniond(camera_from_board)};
}

BoardViews board_views(const Apparatus& apparatus, int n, double spread, std::uint64_t seed) {
  BoardViews views;
  RandomStream random(seed, "views of the board");
  const auto nothing = [](double) -> std::optional<Pose> { return std::nullopt; };
  for (int i = 0; i < n; ++i) {
    SyntheticSettings settings;
    settings.camera_from_board = view_of_board(random, spread);
    settings.hand = false;
    SyntheticCamera camera({apparatus.camera, apparatus.board, {}}, settings, seed);
    views.images.push_back(camera.picture(nothing, 0, static_cast<std::uint64_t>(i)));
    views.names.push_back("view " + std::to_string(i));
  }
  return views;
}

RayErrors ray_errors(const Intrinsics& found, const Intrinsics& truth) {
  constexpr int step_px = 8;
  std::vector<double> errors_px;
  for (int y = 0; y < truth.height_px; y += step_px)
    for (int x = 0; x < truth.width_px; x += step_px) {
      const Eigen::Vector2d pixel(x, y);
      errors_px.push_back((undistort(found, pixel) - undistort(truth, pixel)).norm() * truth.fx_px);
    }
  return {quantile(errors_px, 0.95).value_or(0), quantile(errors_px, 0.5).value_or(0)};
}

}  // namespace heft
