// A Manifold's sweeps: what they fetch from the bodies and hand back.
#include <algorithm>

#include "physics/boxes/Manifold.h"

namespace heft::boxes {

using Eigen::Vector3d;

namespace {
constexpr double right_share = 0.1;  // of a change, squared, that was foreseen wrongly
}

void Manifold::warm_start(Level level) {
  const Impulses& known = rows_[level].impulses;
  if (n_ > 0 && known.col(0).maxCoeff() > 0)
    apply(level, {levers_.transpose() * known.col(0), tangential_sum(known)});
}

void Manifold::extrapolate() {
  if (!surface_.shortcuts) return;
  for (Rows& rows : rows_) {
    const Impulses last = rows.impulses, line = 2 * last - rows.before;
    const double off_before = (last - rows.before).squaredNorm();
    const bool grows = (last - rows.foreseen).squaredNorm() < right_share * off_before;
    rows.before = last;
    rows.foreseen = line;
    for (int i = 0; grows && i < n_; ++i)
      if (line(i, 0) > 0 && last(i, 0) > 0) rows.impulses.row(i) = line.row(i);
  }
}

void Manifold::go_on(Level level, double share) {
  Rows& rows = rows_[level];
  const Impulses swept = rows.impulses;
  rows.impulses += share * (swept - rows.swept);
  rows.swept = swept;
}

double Manifold::relax(Level level) {
  Rows& rows = rows_[level];
  Six now = moving(level), change;
  const double pressed_m_s = press(rows, now, change);
  if (n_ == 4) balance(rows);
  double rubbed_m_s = stick(level, now, change);
  if (rubbed_m_s < 0) {
    // Friction is against the mean slip over the step. The bodies speed up steadily.
    const Vector3d bias = level == end ? at_start_.tangential : Vector3d::Zero();
    rubbed_m_s = slip(rows, now.tangential, bias, change);
  }
  const double changed_m_s = std::max(pressed_m_s, rubbed_m_s);
  if (changed_m_s > 0) apply(level, change);
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

void Manifold::apply(Level level, const Six& impulses_n_s) {
  const auto& [normal, tangential] = impulses_n_s;
  const Vector3d along = normal[0] * normal_ + tangential[0] * u_ + tangential[1] * v_;
  const Vector3d about = tangential[2] * normal_ + normal[1] * u_ + normal[2] * v_;
  first_->step[level].push(along, arm_first_m_.cross(along) + about);
  if (!on_table_) second_->step[level].push(-along, -(arm_second_m_.cross(along) + about));
}

}  // namespace heft::boxes
