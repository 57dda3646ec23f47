#include "physics/boxes/Manifold.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace heft::boxes {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {
constexpr double flat_m = 1e-6;  // gaps and overlaps below this are none
// A contact is looked for anew when masses changed by more, as with another step's length.
constexpr double mass_share_is_new = 1e-9;
constexpr double never_m_s = 1e100;      // at which no two bodies meet
constexpr double recovery = 0.5;         // share of an overlap that one step takes away
constexpr double recovery_m = 1e-3;      // and at most this much
constexpr double least_spread_m = 1e-6;  // of points that are worth calling a patch

Matrix3d columns(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  Matrix3d m;
  m << a, b, c;
  return m;
}
}  // namespace

void Manifold::prepare(const Contact& contact, Body& first, Body& second,
                       const ContactSurface& surface, double h_s, double margin_m) {
  foresee(h_s_ > 0 ? h_s / h_s_ : 1);
  first_ = &first;
  second_ = &second;
  alone_ = second.inverse_mass_per_kg == 0 && !second.solid;
  friction_ = surface.friction;
  h_s_ = h_s;
  rigid_ = surface.compliance_m_per_n == 0;
  same_place_ = surface.same_place;
  foresees_ = surface.foresees;
  seen_ = {first.pose, second.pose, first.inverse_mass_per_kg, second.inverse_mass_per_kg,
           margin_m};
  take_points(contact);
  if (n_ == 0) return;
  couple_bodies();
  prepare_points(surface);
  balance_.setZero();
  if (n_ == 4 && rigid_) find_balance();
}

// Points that were there in the last step keep their impulses, turned into the frame of now.
void Manifold::take_points(const Contact& contact) {
  const std::array<int, 4> features = features_;
  const int n_before = n_;
  n_ = contact.n_points;
  if (n_ == 0) return;
  const Vector3d u = u_, v = v_;
  take_frame(contact);
  const std::array<Impulses, 4> old{impulses_, before_, line_, curve_};
  for (Points* zeroed : {&at_u_m_, &at_v_m_, &prepared_gaps_m_}) zeroed->setZero();
  for (Impulses* zeroed : {&impulses_, &before_, &line_, &curve_}) zeroed->setZero();
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
    line_.row(i) = old[2].row(j);
    curve_.row(i) = old[3].row(j);
  }
  squares_m2_ = at_u_m_.cwiseAbs2() + at_v_m_.cwiseAbs2();
  levers_ << Points::Zero(), at_v_m_, -at_u_m_;
  levers_.col(0).head(n_).setOnes();
  if (u == u_) return;
  for (Impulses* turned : {&impulses_, &before_, &line_, &curve_}) {
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

void Manifold::couple_bodies() {
  press_by_press_.setZero();
  drag_by_press_.setZero();
  drag_by_drag_.setZero();
  press_by_press_(0, 0) = drag_by_drag_(0, 0) = drag_by_drag_(1, 1) =
      first_->inverse_mass_per_kg + second_->inverse_mass_per_kg;
  const auto couple = [this](const Body& body, const Vector3d& arm_m) {
    // As moments about the body's center.
    const Matrix3d press = columns(arm_m.cross(normal_), u_, v_);
    const Matrix3d drag = columns(arm_m.cross(u_), arm_m.cross(v_), normal_);
    const Matrix3d turned_by_press = body.inverse_inertia * press;
    press_by_press_ += press.transpose() * turned_by_press;
    drag_by_press_ += drag.transpose() * turned_by_press;
    drag_by_drag_ += drag.transpose() * (body.inverse_inertia * drag);
  };
  couple(*first_, arm_first_m_);
  if (second_->inertia_kg_m2.x() > 0) couple(*second_, arm_second_m_);
  spread_m_ = std::sqrt(squares_m2_.sum() / n_);
  can_stick_ = drag_by_drag_(2, 2) > 0 && spread_m_ > least_spread_m;
  if (can_stick_) drag_mass_ = drag_by_drag_.inverse();
}

void Manifold::prepare_points(const ContactSurface& surface) {
  response_.noalias() = levers_ * press_by_press_ * levers_.transpose();
  known_ = 0;
  drag_per_kg_.setZero();
  softness_.setZero();
  gaps_m_ = prepared_gaps_m_;
  set_speeds();
  // A compliant point: gap at the end of the step = -compliance (force) - (damping time) (speed),
  // with the damping time that is critical for the mass behind the point.
  const double c = surface.compliance_m_per_n;
  for (int i = 0; i < n_ && c > 0; ++i) {
    const double damping_s = gaps_m_[i] < 0 ? 2 * std::sqrt(c / response_(i, i)) : 0;
    softness_[i] = c / (h_s_ * (h_s_ + damping_s));
    speeds_m_s_[i] = gaps_m_[i] / (h_s_ + damping_s);
  }
}

// Between rigid boxes an overlap is for push_apart, and a gap that is not worth closing is none.
void Manifold::set_speeds() {
  speeds_m_s_ = (gaps_m_.array() > flat_m).select(gaps_m_ / h_s_, 0.0);
  for (int i = n_; i < 4; ++i) speeds_m_s_[i] = never_m_s;
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
  gaps_m_ = prepared_gaps_m_.array() + closer_m;
  set_speeds();
}

bool Manifold::push_apart() {
  bool pushed = false;
  for (int i = 0; i < n_; ++i) {
    if (softness_[i] > 0 || gaps_m_[i] >= -flat_m || response_(i, i) == 0) continue;
    pushed = true;
    const double by_m = std::min(recovery_m, recovery * -(gaps_m_[i] + flat_m)) / n_;
    const Vector3d impulse = by_m / response_(i, i) * normal_;
    const Vector3d from_middle_m = at_u_m_[i] * u_ + at_v_m_[i] * v_;
    const auto push = [&](Body& body, const Vector3d& arm_m, double sign) {
      body.shift(sign * body.inverse_mass_per_kg * impulse,
                 sign * body.response((arm_m + from_middle_m).cross(impulse)));
    };
    push(*first_, arm_first_m_, 1);
    if (!alone_) push(*second_, arm_second_m_, -1);
  }
  return pushed;
}

Vector3d Manifold::impulse_n_s() const {
  const Vector3d sum = impulses_.colwise().sum();
  return n_ == 0 ? Vector3d::Zero() : Vector3d(sum[0] * normal_ + sum[1] * u_ + sum[2] * v_);
}

}  // namespace heft::boxes
