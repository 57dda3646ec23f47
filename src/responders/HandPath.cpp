#include "responders/HandPath.h"

#include <algorithm>

#include "base/Pose.h"

namespace heft {

double minimum_jerk(double u) {
  u = std::clamp(u, 0.0, 1.0);
  return u * u * u * (10 + u * (-15 + 6 * u));
}

double minimum_jerk_duration_s(double distance_m, double peak_speed_m_s) {
  return 15.0 / 8.0 * distance_m / peak_speed_m_s;
}

void HandPath::begin_at(double t_s) {
  start_ = end();
  moves_.clear();
  end_s_ = std::max(end_s_, t_s);
}

void HandPath::move(const Pose& to, double peak_speed_m_s) {
  const double distance_m = (to.position_m - end().position_m).norm();
  if (distance_m == 0) return;
  const double duration_s = minimum_jerk_duration_s(distance_m, peak_speed_m_s);
  moves_.push_back({end_s_, duration_s, end(), to});
  end_s_ += duration_s;
}

Pose HandPath::at(double t_s) const {
  const auto later = std::ranges::upper_bound(moves_, t_s, {}, &HandMove::start_s);
  if (later == moves_.begin()) return start_;
  const HandMove& move = *(later - 1);
  return interpolate(move.from, move.to, minimum_jerk((t_s - move.start_s) / move.duration_s));
}

}  // namespace heft
