// The friction of a Manifold: points that stick as one patch, or slip one by one.
#include <algorithm>
#include <cmath>

#include "physics/boxes/Manifold.h"

namespace heft::boxes {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {
constexpr double least_spread_m = 1e-6;       // of points that are worth calling a patch
constexpr double least_slip_m_s = 1e-4;       // that is worth stopping exactly
constexpr double least_impulse_n_s = 1e-100;  // that can be divided by
constexpr double least_spread_m2 = 1e-12;     // of loads that can bear a moment about the normal

// The most that an impulse along the plane changes a velocity by, at a point.
double response_at(double at_u_m, double at_v_m, const Matrix3d& by_tangential) {
  const Vector3d along_u(1, 0, -at_v_m), along_v(0, 1, at_u_m);
  const Vector3d by_u = by_tangential * along_u;
  const double uu = along_u.dot(by_u), uv = along_v.dot(by_u);
  const double vv = along_v.dot(by_tangential * along_v);
  const double half = (uu - vv) / 2;
  return (uu + vv) / 2 + std::sqrt(half * half + uv * uv);
}
}  // namespace

Vector3d Manifold::tangential_sum(const Impulses& impulses) const {
  const auto u = impulses.col(1), v = impulses.col(2);
  return {u.sum(), v.sum(), at_u_m_.dot(v) - at_v_m_.dot(u)};
}

// Stops the patch where friction is strong enough for that, at every point, if the points share it
// in proportion to their loads.
// @return the velocity that it had, m/s; negative where friction is too weak: nothing is changed
double Manifold::stick(const Six& moving, Six& change) {
  sticks_ = false;
  if (spread_m_ < least_spread_m || !(tangential_by_tangential_(2, 2) > 0)) return -1;
  const Vector3d& over = moving.tangential;
  const Vector3d more = -(tangential_mass_ * over);
  if (!share_friction(more)) return -1;
  sticks_ = true;
  change.tangential += more;
  return std::max({std::abs(over[0]), std::abs(over[1]), std::abs(over[2]) * spread_m_});
}

// Friction at its limit would turn the slip at the start, s0, into one backwards, s, beyond the
// end. A slip that changes steadily from s0 is s on the way, after (1 - mean weight / 2) of the
// step. What stuck before has stopped: what is left of its slip dies out, see BoxWorld.h.
std::optional<double> Manifold::fraction_before_stop() const {
  const Vector3d& slip = at_start_.tangential;
  const double speed_m_s = slip.head<2>().norm();
  if (stuck_ || !sticks_ || speed_m_s < least_slip_m_s) return std::nullopt;
  const Vector3d friction_n_s = tangential_sum(impulses_);
  const double mass_kg = slip.dot(tangential_mass_ * slip) / slip.squaredNorm();
  const double spare_n_s =
      surface_.friction * impulses_.col(0).sum() - friction_n_s.head<2>().norm();
  return (1 - time_.mean_weight() / 2) * speed_m_s /
         (speed_m_s + std::max(0.0, spare_n_s) / mass_kg);
}

// Adds a force impulse and a moment impulse about the patch's middle to the sum of the points'
// friction, and shares the whole among them in proportion to their loads. That leaves no impulses
// that only pull the points against each other.
bool Manifold::share_friction(const Vector3d& more) {
  const Points loads = impulses_.col(0);
  const double load = loads.sum(), friction = surface_.friction;
  if (!(load > 0)) return false;
  const Vector3d sum = tangential_sum(impulses_) + more;
  // Points that share the load cannot hold more than all of it would.
  if (sum.head<2>().squaredNorm() > friction * friction * load * load) return false;
  const double per_load = 1 / load;
  const double center_u_m = loads.dot(at_u_m_) * per_load;
  const double center_v_m = loads.dot(at_v_m_) * per_load;
  const double spread_m2 =
      loads.dot(squares_m2_) * per_load - center_u_m * center_u_m - center_v_m * center_v_m;
  if (!(spread_m2 > least_spread_m2)) return false;
  const double turn = (sum[2] - center_u_m * sum[1] + center_v_m * sum[0]) / spread_m2;
  const Points u = loads.array() * per_load * (sum[0] - turn * (at_v_m_.array() - center_v_m));
  const Points v = loads.array() * per_load * (sum[1] + turn * (at_u_m_.array() - center_u_m));
  const Points beyond = u.cwiseAbs2() + v.cwiseAbs2() - friction * friction * loads.cwiseAbs2();
  if (beyond.maxCoeff() > 0) return false;
  impulses_.col(1) = u;
  impulses_.col(2) = v;
  return true;
}

// By projected gradient on Coulomb's disk, one point after the other: an impulse inside it stops
// the slip; one on its rim is against the mean slip over the step, which is between that at its
// start and the one that is solved for.
// @return the largest change of a velocity at a point, m/s
double Manifold::slip(const Vector3d& slips, Six& change) {
  Vector3d speed = slips;
  double largest = 0;
  const Vector3d bias = (1 - time_.mean_weight()) * at_start_.tangential;
  const Matrix3d& by = tangential_by_tangential_;
  for (int i = 0; i < n_; ++i) {
    const double limit = surface_.friction * impulses_(i, 0);
    const Vector2d was = impulses_.row(i).tail<2>();
    if (limit == 0 && was.isZero(0)) continue;
    const double at_u_m = at_u_m_[i], at_v_m = at_v_m_[i];
    double& kg = slip_kg_[i];
    if (kg == 0) kg = 1 / response_at(at_u_m, at_v_m, by);
    const auto at_point = [&](const Vector3d& of_patch) {
      return Vector2d(of_patch[0] - at_v_m * of_patch[2], of_patch[1] + at_u_m * of_patch[2]);
    };
    Vector2d now = was - kg * at_point(speed);
    if (now.squaredNorm() > limit * limit) {
      now -= kg * at_point(bias);
      now *= limit / std::max(now.norm(), least_impulse_n_s);
    }
    const Vector2d more = now - was;
    if (more.squaredNorm() < noticed_m_s * noticed_m_s * kg * kg) continue;
    const Vector3d on_patch(more[0], more[1], at_u_m * more[1] - at_v_m * more[0]);
    impulses_.row(i).tail<2>() = now;
    speed += by * on_patch;
    change.tangential += on_patch;
    largest = std::max(largest, more.cwiseAbs().maxCoeff() / kg);
  }
  return largest;
}

}  // namespace heft::boxes
