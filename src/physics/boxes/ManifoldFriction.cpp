// The friction of a Manifold: a patch that sticks as a whole, or points that slide one by one.
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "physics/boxes/Manifold.h"

namespace heft::boxes {

using Eigen::Vector3d;

namespace {
constexpr double least_squares_m2 = 1e-12;  // of points that are worth calling a patch
}  // namespace

void Manifold::prepare_patch(const Contact& contact) {
  Vector3d middle_first_m = Vector3d::Zero(), middle_second_m = Vector3d::Zero();
  for (const ContactPoint& at : contact.all()) {
    middle_first_m += at.on_first_m / n_;
    middle_second_m += at.on_second_m / n_;
  }
  patch_.squares_m2 = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(n_); ++i) {
    const Vector3d from_middle_m = contact.points[i].on_first_m - middle_first_m;
    patch_.at_u_m[i] = from_middle_m.dot(u_);
    patch_.at_v_m[i] = from_middle_m.dot(v_);
    patch_.squares_m2 += patch_.at_u_m[i] * patch_.at_u_m[i] + patch_.at_v_m[i] * patch_.at_v_m[i];
  }
  middle_first_m -= first_->pose.position_m;
  middle_second_m -= second_->pose.position_m;
  patch_.u = row(middle_first_m, middle_second_m, u_);
  patch_.v = row(middle_first_m, middle_second_m, v_);
  patch_.spin.turn_first = normal_;
  patch_.spin.response_first = first_->inverse_inertia * normal_;
  patch_.spin.turn_second = -normal_;
  patch_.spin.response_second = -(second_->inverse_inertia * normal_);
  Eigen::Matrix3d response;
  response(0, 0) = inverse_mass(patch_.u, patch_.u, 1);
  response(1, 1) = inverse_mass(patch_.v, patch_.v, 1);
  response(2, 2) = inverse_mass(patch_.spin, patch_.spin, 0);
  response(0, 1) = response(1, 0) = inverse_mass(patch_.u, patch_.v, 0);
  response(0, 2) = response(2, 0) = inverse_mass(patch_.u, patch_.spin, 0);
  response(1, 2) = response(2, 1) = inverse_mass(patch_.v, patch_.spin, 0);
  patch_.usable = response(2, 2) > 0 && patch_.squares_m2 > least_squares_m2;
  if (patch_.usable) patch_.mass = response.inverse();
}

// Stops the patch where friction is strong enough for that, at every point, if the points share it
// in proportion to their loads.
// @return the velocity that it had, m/s; negative where friction is too weak: nothing is changed
double Manifold::hold_patch() {
  const Vector3d moving(speed(patch_.u, u_), speed(patch_.v, v_), turn_speed(patch_.spin));
  const Vector3d change = -(patch_.mass * moving);
  if (!share_friction(change)) return -1;
  apply(patch_.u, u_, change[0]);
  apply(patch_.v, v_, change[1]);
  turn(patch_.spin, change[2]);
  return std::max({std::abs(moving[0]), std::abs(moving[1]),
                   std::abs(moving[2]) * std::sqrt(patch_.squares_m2 / n_)});
}

// Adds a force impulse and a moment impulse about the patch's middle to the sum of the points'
// friction, and shares the whole among them in proportion to their loads. That leaves no impulses
// that only pull the points against each other.
bool Manifold::share_friction(const Vector3d& change) {
  double load = 0, load_u = 0, load_v = 0, load_squares = 0;
  double sum_u = change[0], sum_v = change[1], moment = change[2];
  for (std::size_t i = 0; i < static_cast<std::size_t>(n_); ++i) {
    const Point& point = points_[i];
    const double at_u_m = patch_.at_u_m[i], at_v_m = patch_.at_v_m[i];
    load += point.impulse;
    load_u += point.impulse * at_u_m;
    load_v += point.impulse * at_v_m;
    load_squares += point.impulse * (at_u_m * at_u_m + at_v_m * at_v_m);
    sum_u += point.impulse_u;
    sum_v += point.impulse_v;
    moment += at_u_m * point.impulse_v - at_v_m * point.impulse_u;
  }
  if (!(load > 0)) return false;
  // Points that share the load cannot hold more than all of it would.
  if (sum_u * sum_u + sum_v * sum_v > friction_ * friction_ * load * load) return false;
  const double per_load = 1 / load;
  const double center_u_m = load_u * per_load, center_v_m = load_v * per_load;
  const double spread_m2 =
      load_squares * per_load - center_u_m * center_u_m - center_v_m * center_v_m;
  if (!(spread_m2 > least_squares_m2)) return false;
  const double turn = (moment - center_u_m * sum_v + center_v_m * sum_u) / spread_m2;
  std::array<double, 4> u, v;
  for (std::size_t i = 0; i < static_cast<std::size_t>(n_); ++i) {
    const double share = points_[i].impulse * per_load, limit = friction_ * points_[i].impulse;
    u[i] = share * (sum_u - turn * (patch_.at_v_m[i] - center_v_m));
    v[i] = share * (sum_v + turn * (patch_.at_u_m[i] - center_u_m));
    if (u[i] * u[i] + v[i] * v[i] > limit * limit) return false;
  }
  for (std::size_t i = 0; i < static_cast<std::size_t>(n_); ++i) {
    points_[i].impulse_u = u[i];
    points_[i].impulse_v = v[i];
  }
  return true;
}

// Only where points slide one by one: a patch that sticks does not need them.
void Manifold::prepare_friction(Point& point) {
  point.u = row(point.arm_first_m, point.arm_second_m, u_);
  point.v = row(point.arm_first_m, point.arm_second_m, v_);
  const double uu = inverse_mass(point.u, point.u, 1), vv = inverse_mass(point.v, point.v, 1);
  const double uv = inverse_mass(point.u, point.v, 0);
  const double half = (uu - vv) / 2;
  point.friction_per_kg = (uu + vv) / 2 + std::sqrt(half * half + uv * uv);
  point.friction_mass_kg = 1 / point.friction_per_kg;
}

// One point after the other, by projected gradient on Coulomb's disk: the impulse ends on the
// disk's rim, exactly against the sliding, or inside it, where nothing slides. All points' impulses
// are along u and v: how fast the bodies shift along these is all that matters of their linear
// velocities.
// @return the largest change of a velocity at a point, m/s
double Manifold::slide() {
  const double per_kg = first_->inverse_mass_per_kg + second_->inverse_mass_per_kg;
  double along_u_m_s = shift_speed(u_), along_v_m_s = shift_speed(v_);
  double sum_u = 0, sum_v = 0, largest = 0;
  for (Point& point : points()) {
    const double limit = friction_ * point.impulse;
    if (limit == 0 && point.impulse_u == 0 && point.impulse_v == 0) continue;
    if (point.friction_mass_kg == 0) prepare_friction(point);
    double u = point.impulse_u - point.friction_mass_kg * (along_u_m_s + turn_speed(point.u));
    double v = point.impulse_v - point.friction_mass_kg * (along_v_m_s + turn_speed(point.v));
    const double squared = u * u + v * v;
    if (squared > limit * limit) {
      const double scale = limit / std::sqrt(squared);
      u *= scale;
      v *= scale;
    }
    const double change_u = u - point.impulse_u, change_v = v - point.impulse_v;
    point.impulse_u = u;
    point.impulse_v = v;
    along_u_m_s += per_kg * change_u;
    along_v_m_s += per_kg * change_v;
    sum_u += change_u;
    sum_v += change_v;
    turn(point.u, change_u);
    turn(point.v, change_v);
    largest =
        std::max(largest, std::max(std::abs(change_u), std::abs(change_v)) * point.friction_per_kg);
  }
  shift(u_, sum_u);
  shift(v_, sum_v);
  return largest;
}

}  // namespace heft::boxes
