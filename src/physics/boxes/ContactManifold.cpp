#include "physics/boxes/ContactManifold.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace heft::boxes {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {
constexpr double flat_m = 1e-6;      // gaps and overlaps below this are none
constexpr double touching_m = 2e-6;  // points nearer than this touch
// Those that pressed a step ago: a cube that was thrown ahead must not be pushed before it is met.
constexpr double still_touching_m = 0.03e-3;
constexpr double same_mass = 1e-9;    // a share
constexpr double never_m_s = 1e100;   // at which no two bodies meet
constexpr double parting_m_s = 0.05;  // at most so fast overlaps are undone

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
  sticks_ = sticks_ && n_ > 0;
  first_per_kg_ = -1;  // new
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
  const std::array<Impulses, 3> old{impulses_, before_, foreseen_};
  forget_impulses();
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
    impulses_.row(i) = old[0].row(j);
    before_.row(i) = old[1].row(j);
    foreseen_.row(i) = old[2].row(j);
  }
  squares_m2_ = at_u_m_.cwiseAbs2() + at_v_m_.cwiseAbs2();
  spread_m_ = std::sqrt(squares_m2_.sum() / n_);
  levers_ << Points::Zero(), at_v_m_, -at_u_m_;
  levers_.col(0).head(n_).setOnes();
  balance_.setZero();
  if (n_ == 4 && surface_.compliance_m_per_n == 0) find_balance();
  if (u == u_) return;
  for (Impulses* turned : {&impulses_, &before_, &foreseen_}) {
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

double Manifold::start(double regular_s) {
  gaps_m_ = prepared_gaps_m_.array() + normal_.dot(moved_m());
  at_start_ = moving(first_->velocity, second_->velocity);
  stuck_ = sticks_;
  touching_ = 0;
  double closing_m_s = 0;
  const Points speeds = levers_ * at_start_.normal;
  for (int i = 0; i < n_; ++i) {
    if (gaps_m_[i] > (impulses_(i, 0) > 0 ? still_touching_m : touching_m)) continue;
    touching_ |= 1u << i;
    const double gap_m_s = gaps_m_[i] > flat_m ? gaps_m_[i] / regular_s : 0;
    closing_m_s = std::max(closing_m_s, -speeds[i] - gap_m_s);
  }
  return surface_.compliance_m_per_n > 0 ? 0 : closing_m_s;
}

void Manifold::take_step(const StepTime& time) {
  if (time_.h_s > 0 && time.h_s != time_.h_s)
    for (Impulses* scaled : {&impulses_, &before_, &foreseen_}) *scaled *= time.h_s / time_.h_s;
  time_ = time;
  sticks_ = false;
  couple_if_new();
  set_closing();
}

void Manifold::couple_if_new() {
  if (!as_heavy(first_->step.per_kg, first_per_kg_) ||
      !as_heavy(second_->step.per_kg, second_per_kg_))
    couple();
}

void Manifold::couple() {
  const Motion &first = first_->step, &second = second_->step;
  first_per_kg_ = first.per_kg;
  second_per_kg_ = second.per_kg;
  Matrix3d normal_by_normal = Matrix3d::Zero();
  tangential_by_normal_.setZero();
  tangential_by_tangential_.setZero();
  normal_by_normal(0, 0) = tangential_by_tangential_(0, 0) = tangential_by_tangential_(1, 1) =
      first.per_kg + second.per_kg;
  const auto add = [&](const Motion& motion, const Vector3d& arm_m) {
    // As moments about the body's center.
    const Matrix3d normal = columns(arm_m.cross(normal_), u_, v_);
    const Matrix3d tangential = columns(arm_m.cross(u_), arm_m.cross(v_), normal_);
    const Matrix3d turned_by_normal = motion.per_kg_m2 * normal;
    normal_by_normal += normal.transpose() * turned_by_normal;
    tangential_by_normal_ += tangential.transpose() * turned_by_normal;
    tangential_by_tangential_ += tangential.transpose() * (motion.per_kg_m2 * tangential);
  };
  if (first.turns) add(first, arm_first_m_);
  if (second.turns) add(second, arm_second_m_);
  if (tangential_by_tangential_(2, 2) > 0) tangential_mass_ = tangential_by_tangential_.inverse();
  response_.noalias() = levers_ * normal_by_normal * levers_.transpose();
  stopping_set_ = 0;
  slip_kg_.setZero();
}

// Points that touch close gaps and part overlaps from the step's start to beyond its end.
void Manifold::set_closing() {
  const double c = surface_.compliance_m_per_n;
  softness_.setZero();
  if (c == 0 && touching_ == 0b1111 && gaps_m_.cwiseAbs().maxCoeff() < flat_m) {  // by far most
    closing_m_s_.setZero();
    return;
  }
  closing_m_s_.setConstant(never_m_s);
  double nearest_m = gaps_m_[0];
  for (int i = 1; i < n_; ++i) nearest_m = std::min(nearest_m, gaps_m_[i]);
  for (int i = 0; i < n_; ++i) {
    const double gap_m = gaps_m_[i] < nearest_m + flat_m ? nearest_m : gaps_m_[i];
    if (c > 0) {
      // gap ahead = -compliance (force) - (damping time) (speed), with the damping time that is
      // critical for the mass behind the point
      const double damping_s = gap_m < 0 ? 2 * std::sqrt(c / response_(i, i)) : 0;
      const double over_s = time_.h_s + time_.beyond_s + damping_s;
      softness_[i] = c / (time_.h_s * over_s);
      closing_m_s_[i] = gap_m / over_s;
    } else if (has(touching_, i)) {
      closing_m_s_[i] = 0;
      if (gap_m > flat_m) closing_m_s_[i] = gap_m / (time_.h_s + time_.beyond_s);
      if (gap_m < -flat_m)
        closing_m_s_[i] = -std::min(parting_m_s, -(gap_m + flat_m) / (time_.h_s + time_.beyond_s));
    }
  }
}

void Manifold::stop_at_gaps() {
  if (surface_.compliance_m_per_n > 0) return;
  for (int i = 0; i < n_; ++i)
    if (!has(touching_, i)) closing_m_s_[i] = gaps_m_[i] / (time_.h_s + time_.beyond_s);
}

// Bodies speed up steadily, from how they move at the start to the mean that was found.
std::optional<double> Manifold::fraction_before_meeting() const {
  if (surface_.compliance_m_per_n > 0) return std::nullopt;
  const Points at_start = levers_ * at_start_.normal;
  const Points mean_m_s = levers_ * moving(first_->step.mean, second_->step.mean).normal;
  std::optional<double> soonest;
  for (int i = 0; i < n_; ++i) {
    const double gap_m = gaps_m_[i], start_m = time_.h_s * at_start[i];
    const double mean_m = time_.h_s * mean_m_s[i];
    if (has(touching_, i) || gap_m + mean_m > -flat_m) continue;
    // gap + start s + (mean - start) s^2 = 0
    const double bend_m = mean_m - start_m;
    const double root_m = std::sqrt(std::max(0.0, start_m * start_m - 4 * bend_m * gap_m));
    const double fraction = 2 * gap_m / (root_m - start_m);
    if (fraction > 0) soonest = std::min(soonest.value_or(1), fraction);
  }
  return soonest;
}

void Manifold::begin_hit() {
  couple_if_new();
  held_ = impulses_;
  impulses_.setZero();
  softness_.setZero();
  for (int i = 0; i < n_; ++i) closing_m_s_[i] = has(touching_, i) ? 0 : never_m_s;
}

Vector3d Manifold::end_hit() {
  const Vector3d hit_n_s = in_world(impulses_);
  impulses_ = held_;
  return hit_n_s;
}

void Manifold::forget_impulses() {
  for (Impulses* zeroed : {&impulses_, &before_, &foreseen_}) zeroed->setZero();
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
