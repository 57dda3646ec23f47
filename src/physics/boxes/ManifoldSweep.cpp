// A Manifold's sweeps: what they fetch from the bodies and hand back.
#include <algorithm>

#include "physics/boxes/Manifold.h"

namespace heft::boxes {

using Eigen::Vector3d;

void Manifold::warm_start(Level level) {
  const Impulses& known = rows_[level].impulses;
  if (n_ > 0 && known.col(0).maxCoeff() > 0)
    apply(level, {levers_.transpose() * known.col(0), tangential_sum(known)});
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
