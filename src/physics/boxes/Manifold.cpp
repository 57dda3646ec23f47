#include "physics/boxes/Manifold.h"

#include <algorithm>
#include <cmath>

namespace heft::boxes {

using Eigen::Vector3d;

namespace {
constexpr double firmness = 1e-5;  // of a block's diagonal, so that it can be solved
constexpr double flat_m = 1e-6;    // gaps and overlaps below this are none
// A contact is looked for anew when masses changed by more, as with another step's length.
constexpr double mass_share_is_new = 1e-9;
constexpr double steady = 0.25;        // share of a change that was foreseen wrongly
constexpr double bent = 0.5;           // the same, of what a line foresaw wrongly
constexpr double unmoved_m_s = 1e-10;  // a nanometer in ten seconds
constexpr double recovery = 0.5;       // share of an overlap that one step takes away
constexpr double recovery_m = 1e-3;    // and at most this much
}  // namespace

Manifold::Row Manifold::row(const Vector3d& arm_first_m, const Vector3d& arm_second_m,
                            const Vector3d& direction) const {
  Row row;
  row.turn_first = arm_first_m.cross(direction);
  row.response_first = first_->response(row.turn_first);
  if (alone_) return row;
  row.turn_second = -arm_second_m.cross(direction);
  row.response_second = second_->response(row.turn_second);
  return row;
}

void Manifold::prepare(const Contact& contact, Body& first, Body& second,
                       const ContactSurface& surface, double h_s, double margin_m) {
  struct Known {
    int feature;
    double impulse;
    Vector3d friction, before, line, curve;
  };
  std::array<Known, 4> old;
  const int n_old = n_;
  foresee(h_s_ > 0 ? h_s / h_s_ : 1);
  for (std::size_t i = 0; i < static_cast<std::size_t>(n_old); ++i) {
    const Point& point = points_[i];
    old[i] = {point.feature, point.impulse, point.impulse_u * u_ + point.impulse_v * v_,
              point.before,  point.line,    point.curve};
  }
  first_ = &first;
  second_ = &second;
  alone_ = second.inverse_mass_per_kg == 0 && !second.solid;
  friction_ = surface.friction;
  h_s_ = h_s;
  rigid_ = surface.compliance_m_per_n == 0;
  same_place_ = surface.same_place;
  foresees_ = surface.foresees;
  n_ = contact.n_points;
  if (n_ == 0) return;
  seen_ = {first.pose, second.pose, first.inverse_mass_per_kg, second.inverse_mass_per_kg,
           margin_m};
  if (contact.normal != normal_ || u_ == v_) {
    normal_ = contact.normal;
    u_ = normal_.unitOrthogonal();
    v_ = normal_.cross(u_);
  }
  for (int i = 0; i < n_; ++i) {
    Point& point = points_[static_cast<std::size_t>(i)];
    const ContactPoint& at = contact.points[static_cast<std::size_t>(i)];
    point.impulse = point.impulse_u = point.impulse_v = 0;
    point.before.setZero();
    point.line.setZero();
    point.curve.setZero();
    prepare_point(point, at, surface, h_s);
    const auto before = std::find_if(old.begin(), old.begin() + n_old,
                                     [&](const Known& o) { return o.feature == at.feature; });
    if (before == old.begin() + n_old) continue;
    point.impulse = before->impulse;
    point.before = before->before;
    point.line = before->line;
    point.curve = before->curve;
    point.impulse_u = before->friction.dot(u_);
    point.impulse_v = before->friction.dot(v_);
  }
  couple_points();
  prepare_patch(contact);
  balance_.fill(0);
  if (n_ == 4 && surface.compliance_m_per_n == 0) find_balance(contact);
}

void Manifold::prepare_point(Point& point, const ContactPoint& at, const ContactSurface& surface,
                             double h_s) {
  const Vector3d arm_first_m = at.on_first_m - first_->pose.position_m;
  const Vector3d arm_second_m = at.on_second_m - second_->pose.position_m;
  point.feature = at.feature;
  point.prepared_gap_m = at.distance_m;
  point.normal = row(arm_first_m, arm_second_m, normal_);
  point.arm_first_m = arm_first_m;
  point.arm_second_m = arm_second_m;
  point.friction_mass_kg = 0;
  const double inverse_kg = inverse_mass(point.normal, point.normal, 1);
  // A compliant point: gap at the end of the step = -compliance (force) - (damping time) (speed),
  // with the damping time that is critical for the mass behind the point.
  const double c = surface.compliance_m_per_n;
  const double damping_s = c > 0 && at.distance_m < 0 ? 2 * std::sqrt(c / inverse_kg) : 0;
  point.softness = c / (h_s * (h_s + damping_s));
  set_gap(point, at.distance_m);
  if (c > 0) point.speed_m_s = at.distance_m / (h_s + damping_s);
  point.mass_kg = 1 / (inverse_kg + point.softness);
}

// Between rigid boxes an overlap is for push_apart, and a gap that is not worth closing is none.
void Manifold::set_gap(Point& point, double gap_m) {
  point.gap_m = gap_m;
  point.speed_m_s = gap_m > flat_m ? gap_m / h_s_ : 0;
}

// The first against the second since prepare(). Along the table there is nothing new.
Vector3d Manifold::moved_m() const {
  const Vector3d moved_m = first_->pose.position_m - seen_.first.position_m;
  if (alone_) return {0, 0, moved_m.z()};
  return moved_m - (second_->pose.position_m - seen_.second.position_m);
}

bool Manifold::still_fits(double margin_m) const {
  if (n_ == 0 || !rigid_ || (n_ < 4 && margin_m > seen_.margin_m)) return false;
  if (!alone_ && !touches()) return false;  // it may be the contact of another way
  const auto as_heavy = [](const Body& body, double per_kg) {
    return std::abs(body.inverse_mass_per_kg - per_kg) <= mass_share_is_new * per_kg;
  };
  const double same = same_place_;
  const auto turned = [same](const Pose& now,
                             const Pose& before) {  // half the angle is the difference
    const double half_rad_2 =
        (now.orientation.coeffs() - before.orientation.coeffs()).squaredNorm();
    return 4 * half_rad_2 > same * same;
  };
  return moved_m().squaredNorm() < same * same && as_heavy(*first_, seen_.first_per_kg) &&
         as_heavy(*second_, seen_.second_per_kg) && !turned(first_->pose, seen_.first) &&
         !turned(second_->pose, seen_.second);
}

void Manifold::prepare_again(double h_s) {
  const double closer_m = normal_.dot(moved_m()), scale = h_s / h_s_;
  h_s_ = h_s;
  foresee(scale);
  for (Point& point : points()) set_gap(point, point.prepared_gap_m + closer_m);
}

// Four points on a plane hold a body in more than one way: impulses in the proportions of the
// triangles that the other three points span, with alternating signs, cancel. Real surfaces give a
// little and share the load as evenly as they can; so do we, see balance().
void Manifold::find_balance(const Contact& contact) {
  std::array<double, 4> u_m{}, v_m{};
  for (std::size_t i = 0; i < 4; ++i) {
    u_m[i] = contact.points[i].on_first_m.dot(u_);
    v_m[i] = contact.points[i].on_first_m.dot(v_);
  }
  const auto area = [&](std::size_t a, std::size_t b, std::size_t c) {
    return (u_m[b] - u_m[a]) * (v_m[c] - v_m[a]) - (v_m[b] - v_m[a]) * (u_m[c] - u_m[a]);
  };
  balance_ = {area(1, 2, 3), -area(0, 2, 3), area(0, 1, 3), -area(0, 1, 2)};
  double squares = 0;
  for (double share : balance_) squares += share * share;
  const double scale = squares > 1e-16 ? 1 / std::sqrt(squares) : 0;  // 1e-16 m^4: all on a line
  for (double& share : balance_) share *= scale;
}

// From the last step's impulses to those to start the next one from, `scale` times as long: the
// same again, or on along the line or the parabola through the last ones, as far as that would have
// been right for the last step.
void Manifold::foresee(double scale) {
  double off_before = 0, off_line = 0, off_curve = 0;  // squared
  for (const Point& point : points()) {
    const Vector3d last(point.impulse, point.impulse_u, point.impulse_v);
    off_before += (last - point.before).squaredNorm();
    off_line += (last - point.line).squaredNorm();
    off_curve += (last - point.curve).squaredNorm();
  }
  const bool grows = foresees_ && off_line < steady * steady * off_before;
  const bool bends = grows && off_curve < bent * bent * off_line;
  for (Point& point : points()) {
    const Vector3d last(point.impulse, point.impulse_u, point.impulse_v);
    const Vector3d line = 2 * last - point.before, curve = line + last - point.line;
    point.before = scale * last;
    point.line = scale * line;
    point.curve = scale * curve;
    const Vector3d& foreseen = bends ? point.curve : point.line;
    const Vector3d& start = grows && foreseen[0] > 0 ? foreseen : point.before;
    point.impulse = start[0];
    point.impulse_u = start[1];
    point.impulse_v = start[2];
  }
}

void Manifold::warm_start() {
  double sum_u = 0, sum_v = 0, moment = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(n_); ++i) {
    const Point& point = points_[i];
    if (point.impulse == 0) continue;
    apply(point.normal, normal_, point.impulse);
    sum_u += point.impulse_u;
    sum_v += point.impulse_v;
    moment += patch_.at_u_m[i] * point.impulse_v - patch_.at_v_m[i] * point.impulse_u;
  }
  if (sum_u == 0 && sum_v == 0 && moment == 0) return;
  apply(patch_.u, u_, sum_u);
  apply(patch_.v, v_, sum_v);
  turn(patch_.spin, moment);
}

void Manifold::couple_points() {
  factored_ = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(n_); ++i) {
    for (std::size_t j = 0; j < i; ++j)
      response_[i][j] = response_[j][i] = inverse_mass(points_[i].normal, points_[j].normal, 1);
    response_[i][i] = (1 + firmness) / points_[i].mass_kg;
  }
}

// Cholesky's factor over the active points, kept while the same points are active.
void Manifold::factor(unsigned active) {
  if (active == factored_) return;
  factored_ = active;
  const std::size_t n = static_cast<std::size_t>(n_);
  for (std::size_t i = 0; i < n; ++i) {
    if (!(active >> i & 1)) continue;
    double left = response_[i][i];
    for (std::size_t j = 0; j < i; ++j) {
      factor_[i][j] = 0;
      if (!(active >> j & 1)) continue;
      double sum = response_[i][j];
      for (std::size_t k = 0; k < j; ++k)
        if (active >> k & 1) sum -= factor_[i][k] * factor_[j][k];
      factor_[i][j] = sum * factor_[j][j];
      left -= factor_[i][j] * factor_[i][j];
    }
    factor_[i][i] = 1 / std::sqrt(left);
  }
}

// Most blocks are of this kind.
void Manifold::solve_all_four(std::array<double, 4>& change) const {
  const auto& f = factor_;
  const double a = change[0] * f[0][0];
  const double b = (change[1] - f[1][0] * a) * f[1][1];
  const double c = (change[2] - f[2][0] * a - f[2][1] * b) * f[2][2];
  const double d = (change[3] - f[3][0] * a - f[3][1] * b - f[3][2] * c) * f[3][3];
  change[3] = d * f[3][3];
  change[2] = (c - f[3][2] * change[3]) * f[2][2];
  change[1] = (b - f[2][1] * change[2] - f[3][1] * change[3]) * f[1][1];
  change[0] = (a - f[1][0] * change[1] - f[2][0] * change[2] - f[3][0] * change[3]) * f[0][0];
}

// Solves for the active points; the others' changes are given.
void Manifold::solve_block(unsigned active, std::array<double, 4>& change) const {
  if (active == 0b1111) return solve_all_four(change);
  const std::size_t n = static_cast<std::size_t>(n_);
  for (std::size_t i = 0; i < n; ++i) {
    if (!(active >> i & 1)) continue;
    for (std::size_t j = 0; j < i; ++j)
      if (active >> j & 1) change[i] -= factor_[i][j] * change[j];
    change[i] *= factor_[i][i];
  }
  for (std::size_t i = n; i-- > 0;) {
    if (!(active >> i & 1)) continue;
    for (std::size_t k = i + 1; k < n; ++k)
      if (active >> k & 1) change[i] -= factor_[k][i] * change[k];
    change[i] *= factor_[i][i];
  }
}

// Whether all active points are as fast as they should be.
bool Manifold::unmoved(const std::array<double, 4>& missing, unsigned active) const {
  for (std::size_t i = 0; i < static_cast<std::size_t>(n_); ++i)
    if ((active >> i & 1) && std::abs(missing[i]) > unmoved_m_s) return false;
  return true;
}

// All points at once: a light clone before a heavy cube feels the sum of its points' impulses, the
// cube how they are spread, and one point after the other would find the spread only slowly.
double Manifold::relax_normals() {
  const std::size_t n = static_cast<std::size_t>(n_);
  std::array<double, 4> missing, change{};
  unsigned active = 0;
  const double closing_m_s = shift_speed(normal_);
  for (std::size_t i = 0; i < n; ++i) {
    const Point& point = points_[i];
    missing[i] =
        -closing_m_s - turn_speed(point.normal) - point.speed_m_s - point.softness * point.impulse;
    if (point.impulse != 0 || missing[i] > 0) active |= 1u << i;
  }
  if (active == 0) return 0;
  if (foresees_ && unmoved(missing, active)) return 0;
  while (active != 0) {
    for (std::size_t i = 0; i < n; ++i) {
      if (!(active >> i & 1)) continue;
      change[i] = missing[i];
      for (std::size_t j = 0; j < n; ++j)
        if (!(active >> j & 1)) change[i] -= response_[i][j] * change[j];
    }
    factor(active);
    solve_block(active, change);
    std::size_t worst = 0;
    double lowest = 0;
    for (std::size_t i = 0; i < n; ++i) {
      if (!(active >> i & 1) || points_[i].impulse + change[i] >= lowest) continue;
      lowest = points_[i].impulse + change[i];
      worst = i;
    }
    if (lowest >= 0) break;
    active &= ~(1u << worst);  // it lets go
    change[worst] = -points_[worst].impulse;
  }
  double largest = 0, sum = 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (change[i] == 0) continue;
    largest = std::max(largest, std::abs(missing[i]));
    points_[i].impulse = std::max(0.0, points_[i].impulse + change[i]);
    sum += change[i];
    turn(points_[i].normal, change[i]);
  }
  shift(normal_, sum);
  return largest;
}

// Of all normal impulses that do the same, those with the smallest sum of squares: the limit of
// equally stiff points as they become rigid.
void Manifold::balance() {
  double uneven = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    if (!(points_[i].impulse > 0)) return;
    uneven += balance_[i] * points_[i].impulse;
  }
  for (std::size_t i = 0; i < 4; ++i)  // no further than to zero
    if (uneven * balance_[i] > points_[i].impulse) uneven = points_[i].impulse / balance_[i];
  for (std::size_t i = 0; i < 4; ++i)
    points_[i].impulse = std::max(0.0, points_[i].impulse - uneven * balance_[i]);
}

double Manifold::relax() {
  changed_m_s_ = relax_normals();
  if (n_ == 4) balance();
  const double held = patch_.usable && touches() ? hold_patch() : -1;
  changed_m_s_ = std::max(changed_m_s_, held >= 0 ? held : slide());
  return changed_m_s_;
}

void Manifold::begin_course() {
  for (Point& point : points()) point.end = {point.impulse, point.impulse_u, point.impulse_v};
}

void Manifold::go_on(double share) {
  const auto go_on = [share](double& now, double& end) {
    const double next = now + share * (now - end);
    end = now;
    now = next;
  };
  for (Point& point : points()) {
    go_on(point.impulse, point.end[0]);
    go_on(point.impulse_u, point.end[1]);
    go_on(point.impulse_v, point.end[2]);
  }
}

bool Manifold::push_apart() {
  bool pushed = false;
  for (Point& point : points()) {
    if (point.softness > 0) continue;
    if (point.gap_m >= -flat_m || point.mass_kg == 0) continue;
    pushed = true;
    const double by_m = std::min(recovery_m, recovery * -(point.gap_m + flat_m)) / n_;
    const double impulse = by_m * point.mass_kg;
    first_->shift(impulse * first_->inverse_mass_per_kg * normal_,
                  impulse * point.normal.response_first);
    if (!alone_)
      second_->shift(-impulse * second_->inverse_mass_per_kg * normal_,
                     impulse * point.normal.response_second);
  }
  return pushed;
}

bool Manifold::touches() const {
  return std::ranges::any_of(points(), [](const Point& point) { return point.impulse > 0; });
}

Vector3d Manifold::impulse_n_s() const {
  Vector3d sum = Vector3d::Zero();
  for (const Point& point : points())
    sum += point.impulse * normal_ + point.impulse_u * u_ + point.impulse_v * v_;
  return sum;
}

void Manifold::forget_impulses() {
  for (Point& point : points()) point.impulse = point.impulse_u = point.impulse_v = 0;
}

}  // namespace heft::boxes
