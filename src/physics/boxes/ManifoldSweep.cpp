// A Manifold's sweeps: what they fetch from the bodies and hand back.
#include <algorithm>

#include "physics/boxes/Manifold.h"

namespace heft::boxes {

using Eigen::Vector3d;

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
