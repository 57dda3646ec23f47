#include <cmath>

#include "base/PoseTypes.h"
#include "base/Random.h"
#include "results/physics/scenes/RandomScenes.h"

namespace heft {

namespace {
// Rounds to nanometers and nanoseconds, so that files hold the exact values.
double rounded(double value) {
  return std::round(value * 1e9) / 1e9;
}
}  // namespace

PathBuilder& PathBuilder::to(double t_s, const Eigen::Vector3d& position_m, double yaw_rad) {
  rows_.push_back({rounded(t_s), upright_pose(position_m.unaryExpr(&rounded), yaw_rad)});
  return *this;
}

PathBuilder& PathBuilder::lost(double t_s) {
  rows_.push_back({t_s, std::nullopt});
  return *this;
}

std::vector<TrajectoryRow> StraightPath::rows() const {
  const auto at = [&](double along_m) {
    const double c = std::cos(heading_rad), s = std::sin(heading_rad);
    if (broadside) along_m += 0.025;  // the effector is that much shorter ahead
    return Eigen::Vector3d(along_m * c - side_m * s, along_m * s + side_m * c, hand_height_m);
  };
  const double end_s = length_m / speed_m_s, start_rad = heading_rad + (broadside ? M_PI / 2 : 0),
               end_rad = start_rad + turn_rad;
  return PathBuilder()
      .to(0, at(start_m), start_rad)
      .to(end_s, at(start_m + length_m), end_rad)
      .to(end_s + 1, at(start_m + length_m), end_rad)
      .rows();
}

std::vector<TrajectoryRow> taps() {
  PathBuilder path;
  for (int i = 0; i <= 144; ++i) {
    const double t_s = i / 120.0;
    const double depth_m = -0.005 + 0.0075 * (1 - std::cos(2 * M_PI * 2.5 * t_s));
    path.to(t_s, {-0.0625 + depth_m, 0, hand_height_m});
  }
  return path.rows();
}

std::vector<TrajectoryRow> noisy(const StraightPath& path, double sd_m) {
  const Trajectory smooth(path.rows());
  RandomStream random(1, "bench noise");
  PathBuilder seen;
  const int n = static_cast<int>(std::lround(smooth.end_s() * 60));
  for (int i = 0; i <= n; ++i) {
    Eigen::Vector3d at_m = smooth.at(i / 60.0)->position_m;
    at_m.x() += sd_m * random.normal();
    at_m.y() += sd_m * random.normal();
    seen.to(i / 60.0, at_m);
  }
  return seen.rows();
}

}  // namespace heft
