// The contact solver: block projected Gauss-Seidel over the contact manifolds of a step.
//
// Problem. Every contact point i has a normal impulse p_i and a friction impulse f_i in the contact
// plane. Relative velocities at the points are v = v_free + W (p, f), with the Delassus matrix
// W = J M^-1 J^T. Normal impulses solve a complementarity problem, friction obeys Coulomb's law on
// its disk:
//
//   0 <= p_i  complementary to  v_n,i + softness_i p_i + gap_i / (h + L) >= 0
//   |f_i| <= mu p_i;  v_t,i = 0 where the point sticks, f_i = -mu p_i v_t,i / |v_t,i| where it
//   slides
//
// Rigid points have softness 0. h is the length of the step, L the lookahead.
//
// Velocity. Contact forces are constant over a step. A body moves by its mean velocity over the
// step and enters the next step with its velocity at the end. A constraint on the end velocity
// alone lets bodies drift apart; a constraint on the mean alone lets velocities oscillate from step
// to step. The solver constrains v = w mean + (1 - w) end with w = h / (h + L): gaps are closed at
// time h + L, provided that no force acts after h. With L = h, a step removes two thirds of a gap,
// and both errors decay.
//
// Sweep. One sweep visits each manifold once:
//   1. Normal impulses of all its points together (solve_normal), by an active-set method on the at
//      most 4 x 4 block of W. A light clone in front of a heavy cube responds to the sum of the
//      impulses, the cube to their distribution; point-wise Gauss-Seidel converges slowly on the
//      latter.
//   2. Load sharing (share_load). Four coplanar points are statically indeterminate. The solution
//      with the least sum of squares is the limit of equally stiff points as they become rigid.
//   3. Friction of the whole patch, if it can stick (solve_sticking): one 3 x 3 system, shared in
//      proportion to the normal loads. Otherwise point by point, by projected gradient on the disk
//      (solve_sliding).
//
// Convergence. Impulses start from those of the last step (warm start), scaled to the length of
// this one and extrapolated linearly where that predicted the last step well. Anderson mixing
// combines successive sweeps (BoxWorld::accelerate). If the sweeps diverge, they are repeated from
// zero impulses without mixing (BoxWorld::iterate).
//
// Impacts are the same problem over an instant: h = 0, no gravity, no gaps.
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
constexpr double rounding_m_s = 1e-12;        // approach of an unloaded point that must not load it
constexpr double regularization = 1e-5;       // of a block's diagonal, relative
constexpr double min_area_m2 = 1e-8;          // of points that are not collinear
constexpr double min_spread_m = 1e-6;         // of the points of a patch that can stick
constexpr double min_slip_m_s = 1e-4;         // slower patches are not stopped by an event
constexpr double min_impulse_n_s = 1e-100;    // avoids division by zero
constexpr double min_load_spread_m2 = 1e-12;  // of loads that resist rotation about the normal
constexpr double accepted_error = 0.1;        // of an extrapolation, relative and squared

bool has(unsigned set, int i) {
  return (set >> i & 1) != 0;
}
}  // namespace

// Inverse of the Delassus matrix over a set of points; zero for the others. Cached, because most
// sweeps use the same set.
const Matrix4d& ContactManifold::effective_mass(unsigned set) {
  if (effective_mass_set_ == set) return effective_mass_;
  effective_mass_set_ = set;
  Matrix4d block = Matrix4d::Zero();
  for (int i = 0; i < 4; ++i) {
    block(i, i) = (1 + regularization) * (normal_response_(i, i) + softness_[i]);
    if (!(block(i, i) > 0)) block(i, i) = normal_response_(0, 0);  // unused row
    for (int j = 0; j < i; ++j)
      if (has(set, i) && has(set, j)) block(i, j) = block(j, i) = normal_response_(i, j);
  }
  effective_mass_ = block.inverse();
  for (int i = 0; i < 4; ++i)
    if (!has(set, i)) effective_mass_(i, i) = 0;
  return effective_mass_;
}

// @param motion its tangential part is updated
// @return the largest change of a point's velocity, m/s
double ContactManifold::solve_normal(PatchVector& motion, PatchVector& change) {
  const Points now = impulses_.col(0);
  const Points missing =
      -(lever_arms_ * motion.normal) - approach_limit_m_s_ - softness_.cwiseProduct(now);
  unsigned active = 0;
  for (int i = 0; i < n_; ++i)
    if (now[i] != 0 || missing[i] > rounding_m_s) active |= 1u << i;
  if (active == 0) return 0;
  Points more = effective_mass(active) * missing;
  if ((now + more).minCoeff() < 0) more = release_pulling_points(active, missing);
  const double changed_m_s = (normal_response_ * more).cwiseAbs().maxCoeff();
  if (changed_m_s < negligible_m_s) return 0;
  impulses_.col(0) = (now + more).cwiseMax(0);
  change.normal = lever_arms_.transpose() * more;
  motion.tangential += tangential_by_normal_ * change.normal;
  return changed_m_s;
}

// Removes points with negative impulses from the active set, the worst first.
// @return changes of the normal impulses
ContactManifold::Points ContactManifold::release_pulling_points(unsigned active,
                                                                const Points& missing) {
  const Points now = impulses_.col(0);
  Points more, removed = Points::Zero();
  for (;;) {
    more = effective_mass(active) * (missing - normal_response_ * removed) + removed;
    int worst = 0;
    if ((now + more).minCoeff(&worst) >= 0 || !has(active, worst)) return more;
    active &= ~(1u << worst);
    removed[worst] = -now[worst];
  }
}

// Normal impulses in the proportions of the areas of the triangles that the other three points
// span, with alternating signs, have no resultant.
void ContactManifold::find_null_vector() {
  const auto area = [this](int a, int b, int c) {
    return (u_m_[b] - u_m_[a]) * (v_m_[c] - v_m_[a]) - (v_m_[b] - v_m_[a]) * (u_m_[c] - u_m_[a]);
  };
  const Points areas(area(1, 2, 3), -area(0, 2, 3), area(0, 1, 3), -area(0, 1, 2));
  const double length = areas.norm();
  if (length > min_area_m2) null_vector_ = areas / length;
}

// Removes the component along the null vector, as far as all impulses stay positive.
void ContactManifold::share_load() {
  const Points now = impulses_.col(0);
  if (!(now.minCoeff() > 0)) return;
  double uneven = null_vector_.dot(now);
  for (int i = 0; i < 4; ++i)
    if (uneven * null_vector_[i] > now[i]) uneven = now[i] / null_vector_[i];
  impulses_.col(0) = (now - uneven * null_vector_).cwiseMax(0);
}

namespace {
// Largest eigenvalue of the tangential response of one point.
double largest_response(double at_u_m, double at_v_m, const Matrix3d& by_tangential) {
  const Vector3d along_u(1, 0, -at_v_m), along_v(0, 1, at_u_m);
  const Vector3d by_u = by_tangential * along_u;
  const double uu = along_u.dot(by_u), uv = along_v.dot(by_u);
  const double vv = along_v.dot(by_tangential * along_v);
  const double half = (uu - vv) / 2;
  return (uu + vv) / 2 + std::sqrt(half * half + uv * uv);
}
}  // namespace

Vector3d ContactManifold::tangential_sum(const Impulses& impulses) const {
  const auto u = impulses.col(1), v = impulses.col(2);
  return {u.sum(), v.sum(), u_m_.dot(v) - v_m_.dot(u)};
}

// Stops the patch, if friction in proportion to the loads is within the disk at every point.
// @return the largest change of a point's velocity, m/s; negative if friction is too weak and
// nothing has changed
double ContactManifold::solve_sticking(const PatchVector& motion, PatchVector& change) {
  sticks_ = false;
  if (spread_m_ < min_spread_m || !(tangential_by_tangential_(2, 2) > 0)) return -1;
  const Vector3d& slip = motion.tangential;
  const Vector3d more = -(tangential_mass_ * slip);
  if (!share_friction(more)) return -1;
  sticks_ = true;
  change.tangential += more;
  return std::max({std::abs(slip[0]), std::abs(slip[1]), std::abs(slip[2]) * spread_m_});
}

// Friction at its limit would reverse the slip s0 at the start to s. With constant deceleration,
// the slip has the constrained value after (1 - mean weight / 2) of the step. A patch that stuck
// before needs no event; the rest of its slip decays.
std::optional<double> ContactManifold::fraction_before_sticking() const {
  const Vector3d& slip = at_start_.tangential;
  const double speed_m_s = slip.head<2>().norm();
  if (stuck_at_start_ || !sticks_ || speed_m_s < min_slip_m_s) return std::nullopt;
  const Vector3d friction_n_s = tangential_sum(impulses_);
  const double mass_kg = slip.dot(tangential_mass_ * slip) / slip.squaredNorm();
  const double spare_n_s =
      surface_.friction * impulses_.col(0).sum() - friction_n_s.head<2>().norm();
  return (1 - time_.mean_weight() / 2) * speed_m_s /
         (speed_m_s + std::max(0.0, spare_n_s) / mass_kg);
}

// Adds a force impulse and a moment impulse about the patch's middle to the friction and
// distributes the sum in proportion to the loads, without self-stress.
// @return false if the sum exceeds a point's disk; nothing has changed then
bool ContactManifold::share_friction(const Vector3d& more) {
  const Points loads = impulses_.col(0);
  const double load = loads.sum(), friction = surface_.friction;
  if (!(load > 0)) return false;
  const Vector3d sum = tangential_sum(impulses_) + more;
  // A necessary condition, which is cheaper to test.
  if (sum.head<2>().squaredNorm() > friction * friction * load * load) return false;
  const double per_load = 1 / load;
  const double center_u_m = loads.dot(u_m_) * per_load;
  const double center_v_m = loads.dot(v_m_) * per_load;
  const double spread_m2 =
      loads.dot(squares_m2_) * per_load - center_u_m * center_u_m - center_v_m * center_v_m;
  if (!(spread_m2 > min_load_spread_m2)) return false;
  const double turn = (sum[2] - center_u_m * sum[1] + center_v_m * sum[0]) / spread_m2;
  const Points u = loads.array() * per_load * (sum[0] - turn * (v_m_.array() - center_v_m));
  const Points v = loads.array() * per_load * (sum[1] + turn * (u_m_.array() - center_u_m));
  const Points beyond = u.cwiseAbs2() + v.cwiseAbs2() - friction * friction * loads.cwiseAbs2();
  if (beyond.maxCoeff() > 0) return false;
  impulses_.col(1) = u;
  impulses_.col(2) = v;
  return true;
}

// Projected gradient on Coulomb's disk, point by point. On the rim, friction opposes the mean slip
// over the step, between the slip at its start and the constrained slip.
// @return the largest change of a point's velocity, m/s
double ContactManifold::solve_sliding(const Vector3d& slip, PatchVector& change) {
  Vector3d slip_now = slip;
  double largest = 0;
  const Vector3d bias = (1 - time_.mean_weight()) * at_start_.tangential;
  const Matrix3d& by = tangential_by_tangential_;
  for (int i = 0; i < n_; ++i) {
    const double limit = surface_.friction * impulses_(i, 0);
    const Vector2d was = impulses_.row(i).tail<2>();
    if (limit == 0 && was.isZero(0)) continue;
    const double at_u_m = u_m_[i], at_v_m = v_m_[i];
    double& kg = sliding_mass_kg_[i];
    if (kg == 0) kg = 1 / largest_response(at_u_m, at_v_m, by);
    const auto at_point = [&](const Vector3d& of_patch) {
      return Vector2d(of_patch[0] - at_v_m * of_patch[2], of_patch[1] + at_u_m * of_patch[2]);
    };
    Vector2d now = was - kg * at_point(slip_now);
    if (now.squaredNorm() > limit * limit) {
      now -= kg * at_point(bias);
      now *= limit / std::max(now.norm(), min_impulse_n_s);
    }
    const Vector2d more = now - was;
    if (more.squaredNorm() < negligible_m_s * negligible_m_s * kg * kg) continue;
    const Vector3d on_patch(more[0], more[1], at_u_m * more[1] - at_v_m * more[0]);
    impulses_.row(i).tail<2>() = now;
    slip_now += by * on_patch;
    change.tangential += on_patch;
    largest = std::max(largest, more.cwiseAbs().maxCoeff() / kg);
  }
  return largest;
}

void ContactManifold::warm_start() {
  if (touches()) apply({lever_arms_.transpose() * impulses_.col(0), tangential_sum(impulses_)});
}

void ContactManifold::extrapolate_impulses() {
  if (!surface_.shortcuts || !touches()) return;
  const Impulses last = impulses_, line = 2 * last - previous_;
  const double change = (last - previous_).squaredNorm();
  const bool predictable = (last - predicted_).squaredNorm() < accepted_error * change;
  previous_ = last;
  predicted_ = line;
  for (int i = 0; predictable && i < n_; ++i)
    if (line(i, 0) > 0 && last(i, 0) > 0) impulses_.row(i) = line.row(i);
}

void ContactManifold::extrapolate_sweep(double fraction) {
  const Impulses end = impulses_;
  impulses_ += fraction * (end - sweep_end_);
  sweep_end_ = end;
}

double ContactManifold::sweep() {
  PatchVector now = relative_motion(first_->step.constrained, second_->step.constrained), change;
  const double normal_m_s = solve_normal(now, change);
  if (n_ == 4 && normal_m_s > 0) share_load();
  double friction_m_s = solve_sticking(now, change);
  if (friction_m_s < 0) friction_m_s = solve_sliding(now.tangential, change);
  const double changed_m_s = std::max(normal_m_s, friction_m_s);
  if (changed_m_s > 0) apply(change);
  return changed_m_s;
}

ContactManifold::PatchVector ContactManifold::relative_motion(const Velocity& first,
                                                              const Velocity& second) const {
  Vector3d along = first.linear_m_s + first.angular_rad_s.cross(arm_first_m_);
  Vector3d about = first.angular_rad_s;
  if (!on_table_) {
    along -= second.linear_m_s + second.angular_rad_s.cross(arm_second_m_);
    about -= second.angular_rad_s;
  }
  return {{along.dot(normal_), about.dot(u_), about.dot(v_)},
          {along.dot(u_), along.dot(v_), about.dot(normal_)}};
}

void ContactManifold::apply(const PatchVector& impulses_n_s) {
  const auto& [normal, tangential] = impulses_n_s;
  const Vector3d along = normal[0] * normal_ + tangential[0] * u_ + tangential[1] * v_;
  const Vector3d about = tangential[2] * normal_ + normal[1] * u_ + normal[2] * v_;
  first_->step.apply_impulse(along, arm_first_m_.cross(along) + about);
  if (!on_table_) second_->step.apply_impulse(-along, -(arm_second_m_.cross(along) + about));
}

}  // namespace heft::boxes
