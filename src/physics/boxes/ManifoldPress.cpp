// The normal impulses of a Manifold: all points at once.
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "physics/boxes/Manifold.h"

namespace heft::boxes {

using Eigen::Matrix4d;
using Eigen::Vector3d;

namespace {
// Of a point without a load: whether it is one of those that share must not hang on rounding.
constexpr double rounding_m_s = 1e-12;
constexpr double firmness = 1e-5;       // of a block's diagonal, so that it can be solved
constexpr double least_area_m2 = 1e-8;  // of points that are not on a line

bool has(unsigned set, int i) {
  return (set >> i & 1) != 0;
}
}  // namespace

// The normal impulses at the points of a set that change their velocities as wanted, per velocity;
// zero for the other points. Kept: most sweeps ask for the same set.
const Matrix4d& Manifold::stopping(unsigned set) {
  if (stopping_set_ == set) return stopping_;
  stopping_set_ = set;
  Matrix4d block = Matrix4d::Zero();
  for (int i = 0; i < 4; ++i) {
    block(i, i) = (1 + firmness) * (response_(i, i) + softness_[i]);
    if (!(block(i, i) > 0)) block(i, i) = response_(0, 0);  // no point
    for (int j = 0; j < i; ++j)
      if (has(set, i) && has(set, j)) block(i, j) = block(j, i) = response_(i, j);
  }
  stopping_ = block.inverse();
  for (int i = 0; i < 4; ++i)
    if (!has(set, i)) stopping_(i, i) = 0;
  return stopping_;
}

// All points at once: a light clone before a heavy cube feels the sum of its points' impulses, the
// cube how they are spread, and one point after the other would find the spread only slowly.
// @param moving its tangential part follows
// @return the largest change of a velocity at a point, m/s
double Manifold::press(Six& moving, Six& change) {
  const Points now = impulses_.col(0);
  const Points missing = -(levers_ * moving.normal) - closing_m_s_ - softness_.cwiseProduct(now);
  unsigned active = 0;
  for (int i = 0; i < n_; ++i)
    if (now[i] != 0 || missing[i] > rounding_m_s) active |= 1u << i;
  if (active == 0) return 0;
  Points more = stopping(active) * missing;
  if ((now + more).minCoeff() < 0) more = release(active, missing);
  const double changed_m_s = (response_ * more).cwiseAbs().maxCoeff();
  if (changed_m_s < noticed_m_s) return 0;
  impulses_.col(0) = (now + more).cwiseMax(0);
  change.normal = levers_.transpose() * more;
  moving.tangential += tangential_by_normal_ * change.normal;
  return changed_m_s;
}

// Lets go of one point after the other that would have to pull.
// @return changes of the normal impulses
Manifold::Points Manifold::release(unsigned active, const Points& missing) {
  const Points now = impulses_.col(0);
  Points more, given = Points::Zero();
  for (;;) {
    more = stopping(active) * (missing - response_ * given) + given;
    int worst = 0;
    if ((now + more).minCoeff(&worst) >= 0 || !has(active, worst)) return more;
    active &= ~(1u << worst);
    given[worst] = -now[worst];
  }
}

// Four points on a plane hold a body in more than one way: impulses in the proportions of the
// triangles that the other three points span, with alternating signs, cancel. Real surfaces give a
// little and share the load as evenly as they can; so do we, see balance().
void Manifold::find_balance() {
  const auto area = [this](int a, int b, int c) {
    return (at_u_m_[b] - at_u_m_[a]) * (at_v_m_[c] - at_v_m_[a]) -
           (at_v_m_[b] - at_v_m_[a]) * (at_u_m_[c] - at_u_m_[a]);
  };
  const Points areas(area(1, 2, 3), -area(0, 2, 3), area(0, 1, 3), -area(0, 1, 2));
  const double length = areas.norm();
  if (length > least_area_m2) balance_ = areas / length;
}

// Of all normal impulses that do the same, those with the smallest sum of squares: the limit of
// equally stiff points as they become rigid.
void Manifold::balance() {
  const Points now = impulses_.col(0);
  if (!(now.minCoeff() > 0)) return;
  double uneven = balance_.dot(now);
  for (int i = 0; i < 4; ++i)  // no further than to zero
    if (uneven * balance_[i] > now[i]) uneven = now[i] / balance_[i];
  impulses_.col(0) = (now - uneven * balance_).cwiseMax(0);
}

}  // namespace heft::boxes
