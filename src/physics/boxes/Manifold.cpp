#include "physics/boxes/Manifold.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace heft::boxes {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {
constexpr double flat_m = 1e-6;  // gaps and overlaps below this are none
constexpr double overlap_m = 20e-6;
// Points nearer than this touch; if they pressed a step ago, nearer than that.
constexpr double touching_m = 2e-6, still_touching_m = 0.1e-3;
constexpr double same_mass = 1e-9;   // a share
constexpr double never_m_s = 1e100;  // at which no two bodies meet
constexpr double recovery = 0.5;     // share of an overlap that one step takes away
constexpr double recovery_m = 1e-3;  // and at most this much

bool has(unsigned set, int i) {
  return (set >> i & 1) != 0;
}

Matrix3d columns(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  Matrix3d m;
  m << a, b, c;
  return m;
}

bool as_heavy(double now_per_kg, double then_per_kg) {
  return std::abs(now_per_kg - then_per_kg) <= same_mass * then_per_kg;
}

double turned_rad_2(const Pose& now, const Pose& then) {  // half the angle is the difference
  return 4 * (now.orientation.coeffs() - then.orientation.coeffs()).squaredNorm();
}
}  // namespace

void Manifold::prepare(const Contact& contact, Body& first, Body& second,
                       const ContactSurface& surface, double margin_m) {
  first_ = &first;
  second_ = &second;
  on_table_ = !second.solid;
  surface_ = surface;
  margin_m_ = margin_m;
  first_seen_ = first.pose;
  second_seen_ = second.pose;
  take_points(contact);
  for (Rows& rows : rows_) rows.first_per_kg = -1;  // new
}

// Points that were there in the last step keep their impulses, turned into the frame of now.
void Manifold::take_points(const Contact& contact) {
  const std::array<int, 4> features = features_;
  const int n_before = n_;
  n_ = contact.n_points;
  if (n_ == 0) return;
  const Vector3d u = u_, v = v_;
  take_frame(contact);
  for (Points* zeroed : {&at_u_m_, &at_v_m_, &prepared_gaps_m_}) zeroed->setZero();
  const std::array<Rows, 2> old = rows_;
  for (Rows& rows : rows_)
    for (Impulses* zeroed : {&rows.impulses, &rows.before, &rows.foreseen}) zeroed->setZero();
  for (int i = 0; i < n_; ++i) {
    const ContactPoint& at = contact.points[static_cast<std::size_t>(i)];
    const Vector3d from_middle_m = at.on_first_m - first_->pose.position_m - arm_first_m_;
    features_[static_cast<std::size_t>(i)] = at.feature;
    at_u_m_[i] = from_middle_m.dot(u_);
    at_v_m_[i] = from_middle_m.dot(v_);
    prepared_gaps_m_[i] = at.distance_m;
    const auto known = std::find(features.begin(), features.begin() + n_before, at.feature);
    if (known == features.begin() + n_before) continue;
    const auto j = known - features.begin();
    for (const Level level : both_levels) {
      rows_[level].impulses.row(i) = old[level].impulses.row(j);
      rows_[level].before.row(i) = old[level].before.row(j);
      rows_[level].foreseen.row(i) = old[level].foreseen.row(j);
    }
  }
  squares_m2_ = at_u_m_.cwiseAbs2() + at_v_m_.cwiseAbs2();
  spread_m_ = std::sqrt(squares_m2_.sum() / n_);
  levers_ << Points::Zero(), at_v_m_, -at_u_m_;
  levers_.col(0).head(n_).setOnes();
  balance_.setZero();
  if (n_ == 4 && surface_.compliance_m_per_n == 0) find_balance();
  if (u == u_) return;
  for (Rows& rows : rows_)
    for (Impulses* turned : {&rows.impulses, &rows.before, &rows.foreseen}) {
      const Points along_u = turned->col(1), along_v = turned->col(2);
      turned->col(1) = along_u * u.dot(u_) + along_v * v.dot(u_);
      turned->col(2) = along_u * u.dot(v_) + along_v * v.dot(v_);
    }
}

// The plane of the patch goes through its nearest point: the others bear nothing unless they are as
// near.
void Manifold::take_frame(const Contact& contact) {
  if (contact.normal != normal_ || u_ == v_) {
    normal_ = contact.normal;
    u_ = normal_.unitOrthogonal();
    v_ = normal_.cross(u_);
  }
  Vector3d middle_first_m = Vector3d::Zero(), middle_second_m = Vector3d::Zero();
  const ContactPoint* nearest = contact.points.data();
  for (const ContactPoint& at : contact.all()) {
    middle_first_m += at.on_first_m / n_;
    middle_second_m += at.on_second_m / n_;
    if (at.distance_m < nearest->distance_m) nearest = &at;
  }
  middle_first_m += normal_.dot(nearest->on_first_m - middle_first_m) * normal_;
  middle_second_m += normal_.dot(nearest->on_second_m - middle_second_m) * normal_;
  arm_first_m_ = middle_first_m - first_->pose.position_m;
  arm_second_m_ = middle_second_m - second_->pose.position_m;
}

void Manifold::start() {
  gaps_m_ = prepared_gaps_m_.array() + normal_.dot(moved_m());
  at_start_ = moving(first_->velocity, second_->velocity);
  touching_ = 0;
  for (int i = 0; i < n_; ++i) {
    const bool pressed = rows_[end].impulses(i, 0) > 0;
    if (gaps_m_[i] <= (pressed ? still_touching_m : touching_m)) touching_ |= 1u << i;
  }
}

void Manifold::take_step(double h_s, double parting_m_s) {
  const double scale = h_s > 0 && h_s_ > 0 ? h_s / h_s_ : 1;
  if (h_s > 0) h_s_ = h_s;
  for (const Level level : both_levels) {
    Rows& rows = rows_[level];
    for (Impulses* scaled : {&rows.impulses, &rows.before, &rows.foreseen}) *scaled *= scale;
    const Motion &first = first_->step[level], &second = second_->step[level];
    if (!as_heavy(first.per_kg, rows.first_per_kg) || !as_heavy(second.per_kg, rows.second_per_kg))
      couple(rows, first, second);
  }
  set_closing(parting_m_s);
}

void Manifold::couple(Rows& rows, const Motion& first, const Motion& second) const {
  rows.first_per_kg = first.per_kg;
  rows.second_per_kg = second.per_kg;
  rows.normal_by_normal.setZero();
  rows.tangential_by_normal.setZero();
  rows.tangential_by_tangential.setZero();
  rows.normal_by_normal(0, 0) = rows.tangential_by_tangential(0, 0) =
      rows.tangential_by_tangential(1, 1) = first.per_kg + second.per_kg;
  const auto add = [&](const Motion& motion, const Vector3d& arm_m) {
    // As moments about the body's center.
    const Matrix3d normal = columns(arm_m.cross(normal_), u_, v_);
    const Matrix3d tangential = columns(arm_m.cross(u_), arm_m.cross(v_), normal_);
    const Matrix3d turned_by_normal = motion.per_kg_m2 * normal;
    rows.normal_by_normal += normal.transpose() * turned_by_normal;
    rows.tangential_by_normal += tangential.transpose() * turned_by_normal;
    rows.tangential_by_tangential += tangential.transpose() * (motion.per_kg_m2 * tangential);
  };
  if (first.turns) add(first, arm_first_m_);
  if (second.turns) add(second, arm_second_m_);
  if (rows.tangential_by_tangential(2, 2) > 0)
    rows.tangential_mass = rows.tangential_by_tangential.inverse();
  rows.response.noalias() = levers_ * rows.normal_by_normal * levers_.transpose();
  rows.stopping_set = 0;
  rows.slip_per_kg.setZero();
}

// At which points may close in: at the end of the step those that touch no more; in the mean over
// it those that are a little apart until they meet, and those that overlap part.
void Manifold::set_closing(double parting_m_s) {
  const double c = surface_.compliance_m_per_n;
  for (const Level level : both_levels) {
    Rows& rows = rows_[level];
    rows.softness.setZero();
    rows.closing_m_s.setConstant(never_m_s);
    for (int i = 0; i < n_; ++i) {
      const double gap_m = gaps_m_[i];
      if (c > 0) {
        // gap at the end of the step = -compliance (force) - (damping time) (speed), with the
        // damping time that is critical for the mass behind the point
        const double damping_s = gap_m < 0 ? 2 * std::sqrt(c / rows_[end].response(i, i)) : 0;
        rows.softness[i] = c / (h_s_ * (h_s_ + damping_s));
        rows.closing_m_s[i] = gap_m / (h_s_ + damping_s);
      } else if (has(touching_, i)) {
        rows.closing_m_s[i] = 0;
        if (level == mean && gap_m > flat_m) rows.closing_m_s[i] = gap_m / h_s_;
        if (level == mean && gap_m < -flat_m)
          rows.closing_m_s[i] =
              -std::min(parting_m_s, std::min(recovery * -(gap_m + flat_m), recovery_m) / h_s_);
      }
    }
  }
}

void Manifold::stop_at_gaps() {
  if (surface_.compliance_m_per_n > 0) return;
  for (int i = 0; i < n_; ++i)
    if (!has(touching_, i)) rows_[mean].closing_m_s[i] = gaps_m_[i] / h_s_;
}

bool Manifold::parts_driven() const {
  return (first_->driven || second_->driven) && gaps_m_.head(n_).minCoeff() < -overlap_m;
}

double Manifold::closing_m_s() const {
  const Points speeds = levers_ * at_start_.normal;
  double fastest_m_s = 0;
  for (int i = 0; i < n_; ++i)
    if (has(touching_, i)) fastest_m_s = std::max(fastest_m_s, -speeds[i]);
  return surface_.compliance_m_per_n > 0 ? 0 : fastest_m_s;
}

// Bodies speed up steadily, from how they move at the start to the mean that was found.
std::optional<double> Manifold::share_before_hit() const {
  if (surface_.compliance_m_per_n > 0) return std::nullopt;
  const Points at_start = levers_ * at_start_.normal, mean_m_s = levers_ * moving(mean).normal;
  std::optional<double> soonest;
  for (int i = 0; i < n_; ++i) {
    const double gap_m = gaps_m_[i], start_m = h_s_ * at_start[i], mean_m = h_s_ * mean_m_s[i];
    if (has(touching_, i) || gap_m + mean_m > -flat_m) continue;
    // gap + start s + (mean - start) s^2 = 0
    const double bend_m = mean_m - start_m;
    const double root_m = std::sqrt(std::max(0.0, start_m * start_m - 4 * bend_m * gap_m));
    const double share = 2 * gap_m / (root_m - start_m);
    if (share > 0) soonest = std::min(soonest.value_or(1), share);
  }
  return soonest;
}

Vector3d Manifold::end_hit() {
  const Vector3d hit_n_s = in_world(rows_[end].impulses);
  rows_[end].impulses = rows_[mean].impulses;
  return hit_n_s;
}

void Manifold::forget_impulses() {
  for (Rows& rows : rows_)
    for (Impulses* zeroed : {&rows.impulses, &rows.before, &rows.foreseen}) zeroed->setZero();
}

// The first against the second since prepare(). Along the table there is nothing new.
Vector3d Manifold::moved_m() const {
  const Vector3d moved_m = first_->pose.position_m - first_seen_.position_m;
  if (on_table_) return {0, 0, moved_m.z()};
  return moved_m - (second_->pose.position_m - second_seen_.position_m);
}

bool Manifold::still_fits(double margin_m) const {
  if (n_ == 0 || (n_ < 4 && margin_m > margin_m_)) return false;
  if (!on_table_ && !touches()) return false;  // it may be the contact of another way
  const double same_2 = surface_.same_place() * surface_.same_place();
  return moved_m().squaredNorm() < same_2 && turned_rad_2(first_->pose, first_seen_) < same_2 &&
         turned_rad_2(second_->pose, second_seen_) < same_2;
}

Vector3d Manifold::in_world(const Impulses& impulses) const {
  const Vector3d sum = impulses.colwise().sum();
  return n_ == 0 ? Vector3d::Zero() : Vector3d(sum[0] * normal_ + sum[1] * u_ + sum[2] * v_);
}

}  // namespace heft::boxes
