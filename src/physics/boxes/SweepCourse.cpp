#include "physics/boxes/SweepCourse.h"

#include <algorithm>

namespace heft::boxes {

using Eigen::Vector3d;

namespace {
constexpr double farthest_share = 100;
}

void SweepCourse::begin(std::span<const Body> bodies, std::span<Manifold* const> manifolds) {
  last_energy_j_ = 0;
  of_bodies_.resize(bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i)
    of_bodies_[i] = {bodies[i].velocity, {}, bodies[i].velocity};
  for (Manifold* manifold : manifolds) manifold->begin_course();
}

// How far to go on, in the distance of the last two sweeps' ends: to where the changes would have
// the least energy if they went on changing as they do.
double SweepCourse::share_ahead(std::span<const Body> bodies) {
  double energy_j = 0, common_j = 0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Body& body = bodies[i];
    if (!(body.inverse_mass_per_kg > 0)) continue;
    auto& [start, change, end] = of_bodies_[i];
    const Vector3d faster = body.velocity.linear_m_s - start.linear_m_s;
    const Vector3d turns_faster = body.velocity.angular_rad_s - start.angular_rad_s;
    const double mass = 1 / body.inverse_mass_per_kg, inertia = body.inertia_kg_m2.maxCoeff();
    energy_j += mass * faster.squaredNorm() + inertia * turns_faster.squaredNorm();
    common_j +=
        mass * faster.dot(change.linear_m_s) + inertia * turns_faster.dot(change.angular_rad_s);
    change = {faster, turns_faster};
  }
  const double between_j = energy_j + last_energy_j_ - 2 * common_j;
  const bool first = last_energy_j_ == 0;
  last_energy_j_ = energy_j;
  if (first || !(between_j > 0)) return 0;
  return std::clamp((common_j - energy_j) / between_j, 0.0, farthest_share);
}

void SweepCourse::go_on(std::span<Body> bodies, std::span<Manifold* const> manifolds) {
  const double share = share_ahead(bodies);
  const auto go_on = [share](Vector3d& now, Vector3d& start, Vector3d& end) {
    start = now + share * (now - end);
    end = now;
    now = start;
  };
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    auto& [start, change, end] = of_bodies_[i];
    go_on(bodies[i].velocity.linear_m_s, start.linear_m_s, end.linear_m_s);
    go_on(bodies[i].velocity.angular_rad_s, start.angular_rad_s, end.angular_rad_s);
  }
  for (Manifold* manifold : manifolds) manifold->go_on(share);
}

}  // namespace heft::boxes
