#include "tracking/SeenEffector.h"

#include "base/Pose.h"

namespace heft {

namespace {
constexpr double longest_gap_s = 0.25;  // Drive treats a longer one as a jump, too
// Beyond the speed of a hand with a light box.
constexpr double fastest_m_s = 5, fastest_rad_s = 30;
constexpr double jitter_m = 0.01, jitter_rad = 0.2;
// Under a rolling shutter the very first pose is a mean over rows, and no velocity can be derived
// from it.
constexpr int poses_of_a_trend = 3;
}  // namespace

Pose normalized(Pose pose) {
  pose.orientation.normalize();
  return pose;
}

bool SeenEffector::is_recent_at(double then_s) const {
  return then_s - t_s <= longest_gap_s;
}

Pose SeenEffector::expected_at(double then_s, const Velocity& by) const {
  const double dt_s = then_s - t_s;
  return normalized(
      {board_from_effector.position_m + dt_s * by.linear_m_s,
       rotation_from_vector(dt_s * by.angular_rad_s) * board_from_effector.orientation});
}

bool SeenEffector::could_be_at(const Pose& pose, double then_s) const {
  if (!is_recent_at(then_s)) return false;
  const double dt_s = then_s - t_s;
  const double way_m = (pose.position_m - board_from_effector.position_m).norm();
  const double turn_rad = pose.orientation.angularDistance(board_from_effector.orientation);
  return way_m < fastest_m_s * dt_s + jitter_m && turn_rad < fastest_rad_s * dt_s + jitter_rad;
}

Velocity SeenEffector::carried_on(const Velocity& mean, double by_pictures) const {
  if (n_poses < poses_of_a_trend) return mean;
  return {mean.linear_m_s + by_pictures * (mean.linear_m_s - velocity.linear_m_s),
          mean.angular_rad_s + by_pictures * (mean.angular_rad_s - velocity.angular_rad_s)};
}

SeenEffector SeenEffector::moved_to(double then_s, double then_own_row_s, const Pose& pose,
                                    int n_intervals) const {
  const Velocity mean = mean_velocity(board_from_effector, pose, n_intervals * (then_s - t_s));
  return {then_s, then_own_row_s, pose, mean, carried_on(mean, 1), n_poses + 1};
}

}  // namespace heft
