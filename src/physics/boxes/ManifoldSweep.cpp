// A Manifold's sweeps: from where they start, what they fetch from the bodies and hand back.
#include <algorithm>

#include "physics/boxes/Manifold.h"

namespace heft::boxes {

using Eigen::Vector3d;

namespace {
constexpr double steady = 0.25;  // share of a change that was foreseen wrongly
constexpr double bent = 0.5;     // the same, of what a line foresaw wrongly
}  // namespace

// From the last step's impulses to those to start the next one from, `scale` times as long: the
// same again, or on along the line or the parabola through the last ones, as far as that would have
// been right for the last step.
void Manifold::foresee(double scale) {
  const double off_before = (impulses_ - before_).squaredNorm();
  const double off_line = (impulses_ - line_).squaredNorm();
  const double off_curve = (impulses_ - curve_).squaredNorm();
  const bool grows = foresees_ && off_line < steady * steady * off_before;
  const bool bends = grows && off_curve < bent * bent * off_line;
  const Impulses line = 2 * impulses_ - before_, curve = line + impulses_ - line_;
  before_ = scale * impulses_;
  line_ = scale * line;
  curve_ = scale * curve;
  impulses_ = before_;
  if (!grows) return;
  const Impulses& foreseen = bends ? curve_ : line_;
  for (int i = 0; i < 4; ++i)
    if (foreseen(i, 0) > 0) impulses_.row(i) = foreseen.row(i);
}

void Manifold::forget_impulses() {
  for (Impulses* known : {&impulses_, &before_, &line_, &curve_}) known->setZero();
}

void Manifold::warm_start() {
  if (touches()) apply(sum_n_s());
}

double Manifold::relax() {
  Patch now = moving(), change;
  changed_m_s_ = press(now, change);
  if (n_ == 4) balance();
  const double held = can_stick_ && touches() ? hold(now, change) : -1;
  changed_m_s_ = std::max(changed_m_s_, held >= 0 ? held : slide(now, change));
  if (changed_m_s_ > 0) apply(change);
  return changed_m_s_;
}

Manifold::Patch Manifold::moving() const {
  const Velocity& first = first_->velocity;
  Vector3d along = first.linear_m_s + first.angular_rad_s.cross(arm_first_m_);
  Vector3d about = first.angular_rad_s;
  if (!alone_) {
    const Velocity& second = second_->velocity;
    along -= second.linear_m_s + second.angular_rad_s.cross(arm_second_m_);
    about -= second.angular_rad_s;
  }
  return {{along.dot(normal_), about.dot(u_), about.dot(v_)},
          {along.dot(u_), along.dot(v_), about.dot(normal_)}};
}

// The points' impulses, summed up at the middle.
Manifold::Patch Manifold::sum_n_s() const {
  return {levers_.transpose() * impulses_.col(0), dragged_n_s()};
}

void Manifold::apply(const Patch& impulses_n_s) {
  const auto& [press, drag] = impulses_n_s;
  const Vector3d along = press[0] * normal_ + drag[0] * u_ + drag[1] * v_;
  const Vector3d about = drag[2] * normal_ + press[1] * u_ + press[2] * v_;
  const auto push = [&](Body& body, const Vector3d& arm_m, double sign) {
    body.velocity.linear_m_s += (sign * body.inverse_mass_per_kg) * along;
    if (body.inertia_kg_m2.x() > 0)
      body.velocity.angular_rad_s += sign * body.response(arm_m.cross(along) + about);
  };
  push(*first_, arm_first_m_, 1);
  if (!alone_) push(*second_, arm_second_m_, -1);
}

void Manifold::go_on(double share) {
  const Impulses next = impulses_ + share * (impulses_ - end_);
  end_ = impulses_;
  impulses_ = next;
}

}  // namespace heft::boxes
