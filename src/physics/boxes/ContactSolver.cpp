// The iterations of a Manifold: normal impulses, friction impulses and whole sweeps.
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "physics/boxes/ContactManifold.h"

namespace heft::boxes {

using Eigen::Matrix3d;
using Eigen::Matrix4d;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {
// Of a point without a load: whether it is one of those that share must not hang on rounding.
constexpr double rounding_m_s = 1e-12;
constexpr double firmness = 1e-5;       // of a block's diagonal, so that it can be solved
constexpr double least_area_m2 = 1e-8;  // of points that are not on a line

bool has(unsigned set, int i) {
  return (set >> i & 1) != 0;
}
}  // namespace

// The normal impulses at the points of a set that change their velocities as wanted, per velocity;
// zero for the other points. Kept: most sweeps ask for the same set.
const Matrix4d& Manifold::stopping(unsigned set) {
  if (stopping_set_ == set) return stopping_;
  stopping_set_ = set;
  Matrix4d block = Matrix4d::Zero();
  for (int i = 0; i < 4; ++i) {
    block(i, i) = (1 + firmness) * (response_(i, i) + softness_[i]);
    if (!(block(i, i) > 0)) block(i, i) = response_(0, 0);  // no point
    for (int j = 0; j < i; ++j)
      if (has(set, i) && has(set, j)) block(i, j) = block(j, i) = response_(i, j);
  }
  stopping_ = block.inverse();
  for (int i = 0; i < 4; ++i)
    if (!has(set, i)) stopping_(i, i) = 0;
  return stopping_;
}

// All points at once: a light clone before a heavy cube feels the sum of its points' impulses, the
// cube how they are spread, and one point after the other would find the spread only slowly.
// @param moving its tangential part follows
// @return the largest change of a velocity at a point, m/s
double Manifold::press(Six& moving, Six& change) {
  const Points now = impulses_.col(0);
  const Points missing = -(levers_ * moving.normal) - closing_m_s_ - softness_.cwiseProduct(now);
  unsigned active = 0;
  for (int i = 0; i < n_; ++i)
    if (now[i] != 0 || missing[i] > rounding_m_s) active |= 1u << i;
  if (active == 0) return 0;
  Points more = stopping(active) * missing;
  if ((now + more).minCoeff() < 0) more = release(active, missing);
  const double changed_m_s = (response_ * more).cwiseAbs().maxCoeff();
  if (changed_m_s < noticed_m_s) return 0;
  impulses_.col(0) = (now + more).cwiseMax(0);
  change.normal = levers_.transpose() * more;
  moving.tangential += tangential_by_normal_ * change.normal;
  return changed_m_s;
}

// Lets go of one point after the other that would have to pull.
// @return changes of the normal impulses
Manifold::Points Manifold::release(unsigned active, const Points& missing) {
  const Points now = impulses_.col(0);
  Points more, given = Points::Zero();
  for (;;) {
    more = stopping(active) * (missing - response_ * given) + given;
    int worst = 0;
    if ((now + more).minCoeff(&worst) >= 0 || !has(active, worst)) return more;
    active &= ~(1u << worst);
    given[worst] = -now[worst];
  }
}

// Four points on a plane hold a body in more than one way: impulses in the proportions of the
// triangles that the other three points span, with alternating signs, cancel. Real surfaces give a
// little and share the load as evenly as they can; so do we, see balance().
void Manifold::find_balance() {
  const auto area = [this](int a, int b, int c) {
    return (at_u_m_[b] - at_u_m_[a]) * (at_v_m_[c] - at_v_m_[a]) -
           (at_v_m_[b] - at_v_m_[a]) * (at_u_m_[c] - at_u_m_[a]);
  };
  const Points areas(area(1, 2, 3), -area(0, 2, 3), area(0, 1, 3), -area(0, 1, 2));
  const double length = areas.norm();
  if (length > least_area_m2) balance_ = areas / length;
}

// Of all normal impulses that do the same, those with the smallest sum of squares: the limit of
// equally stiff points as they become rigid.
void Manifold::balance() {
  const Points now = impulses_.col(0);
  if (!(now.minCoeff() > 0)) return;
  double uneven = balance_.dot(now);
  for (int i = 0; i < 4; ++i)  // no further than to zero
    if (uneven * balance_[i] > now[i]) uneven = now[i] / balance_[i];
  impulses_.col(0) = (now - uneven * balance_).cwiseMax(0);
}

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

namespace {
constexpr double right_enough = 0.1;  // of a change, squared, that was foreseen wrongly
}  // namespace

void Manifold::warm_start() {
  if (touches()) apply({levers_.transpose() * impulses_.col(0), tangential_sum(impulses_)});
}

void Manifold::extrapolate() {
  if (!surface_.shortcuts || !touches()) return;
  const Impulses last = impulses_, line = 2 * last - before_;
  const double off_before = (last - before_).squaredNorm();
  const bool grows = (last - foreseen_).squaredNorm() < right_enough * off_before;
  before_ = last;
  foreseen_ = line;
  for (int i = 0; grows && i < n_; ++i)
    if (line(i, 0) > 0 && last(i, 0) > 0) impulses_.row(i) = line.row(i);
}

void Manifold::go_on(double fraction) {
  const Impulses swept = impulses_;
  impulses_ += fraction * (swept - swept_);
  swept_ = swept;
}

double Manifold::relax() {
  Six now = moving(first_->step.ahead, second_->step.ahead), change;
  const double pressed_m_s = press(now, change);
  if (n_ == 4 && pressed_m_s > 0) balance();
  double rubbed_m_s = stick(now, change);
  if (rubbed_m_s < 0) rubbed_m_s = slip(now.tangential, change);
  const double changed_m_s = std::max(pressed_m_s, rubbed_m_s);
  if (changed_m_s > 0) apply(change);
  return changed_m_s;
}

Manifold::Six Manifold::moving(const Velocity& first, const Velocity& second) const {
  Vector3d along = first.linear_m_s + first.angular_rad_s.cross(arm_first_m_);
  Vector3d about = first.angular_rad_s;
  if (!on_table_) {
    along -= second.linear_m_s + second.angular_rad_s.cross(arm_second_m_);
    about -= second.angular_rad_s;
  }
  return {{along.dot(normal_), about.dot(u_), about.dot(v_)},
          {along.dot(u_), along.dot(v_), about.dot(normal_)}};
}

void Manifold::apply(const Six& impulses_n_s) {
  const auto& [normal, tangential] = impulses_n_s;
  const Vector3d along = normal[0] * normal_ + tangential[0] * u_ + tangential[1] * v_;
  const Vector3d about = tangential[2] * normal_ + normal[1] * u_ + normal[2] * v_;
  first_->step.push(along, arm_first_m_.cross(along) + about);
  if (!on_table_) second_->step.push(-along, -(arm_second_m_.cross(along) + about));
}

}  // namespace heft::boxes
