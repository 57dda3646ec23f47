// The friction of a Manifold: points that stick as one patch, or slide one by one.
#include <algorithm>
#include <cmath>

#include "physics/boxes/Manifold.h"

namespace heft::boxes {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {
constexpr double least_squared_m2_s2 = 1e-300;  // that can be divided by
constexpr double least_spread_m2 = 1e-12;       // of loads that can bear a moment about the normal

// The most that an impulse along the plane changes a velocity by, at a point.
double response_at(double at_u_m, double at_v_m, const Matrix3d& drag_by_drag) {
  const Vector3d along_u(1, 0, -at_v_m), along_v(0, 1, at_u_m);
  const Vector3d by_u = drag_by_drag * along_u;
  const double uu = along_u.dot(by_u), uv = along_v.dot(by_u);
  const double vv = along_v.dot(drag_by_drag * along_v);
  const double half = (uu - vv) / 2;
  return (uu + vv) / 2 + std::sqrt(half * half + uv * uv);
}
}  // namespace

// Stops the patch where friction is strong enough for that, at every point, if the points share it
// in proportion to their loads.
// @return the velocity that it had, m/s; negative where friction is too weak: nothing is changed
double Manifold::hold(const Patch& moving, Patch& change) {
  const Vector3d more = -(drag_mass_ * moving.drag);
  if (!share_friction(more)) return -1;
  change.drag += more;
  return std::max(
      {std::abs(moving.drag[0]), std::abs(moving.drag[1]), std::abs(moving.drag[2]) * spread_m_});
}

// Adds a force impulse and a moment impulse about the patch's middle to the sum of the points'
// friction, and shares the whole among them in proportion to their loads. That leaves no impulses
// that only pull the points against each other.
bool Manifold::share_friction(const Vector3d& more) {
  const Points loads = impulses_.col(0);
  const double load = loads.sum();
  if (!(load > 0)) return false;
  const Vector3d sum = dragged_n_s() + more;
  // Points that share the load cannot hold more than all of it would.
  if (sum[0] * sum[0] + sum[1] * sum[1] > friction_ * friction_ * load * load) return false;
  const double per_load = 1 / load;
  const double center_u_m = loads.dot(at_u_m_) * per_load;
  const double center_v_m = loads.dot(at_v_m_) * per_load;
  const double spread_m2 =
      loads.dot(squares_m2_) * per_load - center_u_m * center_u_m - center_v_m * center_v_m;
  if (!(spread_m2 > least_spread_m2)) return false;
  const double turn = (sum[2] - center_u_m * sum[1] + center_v_m * sum[0]) / spread_m2;
  const Points u = loads.array() * per_load * (sum[0] - turn * (at_v_m_.array() - center_v_m));
  const Points v = loads.array() * per_load * (sum[1] + turn * (at_u_m_.array() - center_u_m));
  const Points beyond = u.cwiseAbs2() + v.cwiseAbs2() - friction_ * friction_ * loads.cwiseAbs2();
  if (beyond.maxCoeff() > 0) return false;
  impulses_.col(1) = u;
  impulses_.col(2) = v;
  return true;
}

// By projected gradient on Coulomb's disk: the impulse ends on the disk's rim, exactly against the
// sliding, or inside it, where nothing slides.
// @return the largest change of a velocity at a point, m/s
double Manifold::slide(const Patch& moving, Patch& change) {
  const Points before_u = impulses_.col(1), before_v = impulses_.col(2);
  for (int i = 0; i < n_; ++i)
    if (drag_per_kg_[i] == 0) drag_per_kg_[i] = response_at(at_u_m_[i], at_v_m_[i], drag_by_drag_);
  if (!foresees_ || !slide_together(moving.drag)) slide_one_by_one(moving.drag);
  const Points more_u = impulses_.col(1) - before_u, more_v = impulses_.col(2) - before_v;
  change.drag += Vector3d(more_u.sum(), more_v.sum(), at_u_m_.dot(more_v) - at_v_m_.dot(more_u));
  return more_u.cwiseAbs().cwiseMax(more_v.cwiseAbs()).cwiseProduct(drag_per_kg_).maxCoeff();
}

// All points at once, if all that are loaded slide. Each step is as small as it has to be where all
// of them push the same way.
bool Manifold::slide_together(const Vector3d& speed) {
  const auto limits = friction_ * impulses_.col(0).array();
  // Impulses times how they all change the drag.
  const Points per_kg = n_ * drag_per_kg_;
  const Eigen::Array4d u =
      impulses_.col(1).cwiseProduct(per_kg) - (Points::Constant(speed[0]) - speed[2] * at_v_m_);
  const Eigen::Array4d v =
      impulses_.col(2).cwiseProduct(per_kg) - (Points::Constant(speed[1]) + speed[2] * at_u_m_);
  const Eigen::Array4d squared = u.square() + v.square();
  const Eigen::Array4d rims = limits * per_kg.array();
  if ((squared - rims.square()).minCoeff() < 0) return false;
  const Eigen::Array4d scale = limits / squared.max(least_squared_m2_s2).sqrt();
  impulses_.col(1) = u * scale;
  impulses_.col(2) = v * scale;
  return true;
}

void Manifold::slide_one_by_one(const Vector3d& speed) {
  Points along_u = impulses_.col(1), along_v = impulses_.col(2);
  double speed_u = speed[0], speed_v = speed[1], spin = speed[2];
  const Matrix3d& by = drag_by_drag_;
  for (int i = 0; i < n_; ++i) {
    const double limit = friction_ * impulses_(i, 0);
    if (limit == 0 && along_u[i] == 0 && along_v[i] == 0) continue;
    const double at_u_m = at_u_m_[i], at_v_m = at_v_m_[i];
    const double mass_kg = 1 / drag_per_kg_[i];
    double u = along_u[i] - mass_kg * (speed_u - at_v_m * spin);
    double v = along_v[i] - mass_kg * (speed_v + at_u_m * spin);
    const double squared = u * u + v * v;
    if (squared > limit * limit) {
      const double scale = limit / std::sqrt(squared);
      u *= scale;
      v *= scale;
    }
    const double more_u = u - along_u[i], more_v = v - along_v[i];
    const double moment = at_u_m * more_v - at_v_m * more_u;
    along_u[i] = u;
    along_v[i] = v;
    speed_u += by(0, 0) * more_u + by(0, 1) * more_v + by(0, 2) * moment;
    speed_v += by(1, 0) * more_u + by(1, 1) * more_v + by(1, 2) * moment;
    spin += by(2, 0) * more_u + by(2, 1) * more_v + by(2, 2) * moment;
  }
  impulses_.col(1) = along_u;
  impulses_.col(2) = along_v;
}

}  // namespace heft::boxes
