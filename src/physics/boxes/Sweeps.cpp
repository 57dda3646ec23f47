// Sweeps of the contact solver over the manifolds of a step, until they converge.
#include <algorithm>

#include "physics/boxes/BoxWorld.h"

namespace heft::boxes {

namespace {
constexpr double max_extrapolation = 100;  // of Anderson mixing, in sweeps
constexpr int max_sweeps = 300;
constexpr double converged_m_s = 1e-5;  // largest velocity change of the last sweep
constexpr double diverged_m_s = 0.01;   // larger last changes mean that no solution exists
}  // namespace

// If sweeps diverge, they are repeated without warm start and mixing, where each sweep dissipates
// energy. Where a clone squeezes a cube there is no solution and the impulses grow without bound;
// they must not start the next step.
void BoxWorld::iterate() {
  double change_m_s = run_sweeps(surface_.shortcuts);
  if (change_m_s > diverged_m_s) {
    clear_impulses();
    for (Body& body : bodies_) body.step.constrained = body.step.free;
    change_m_s = run_sweeps(false);
  }
  if (change_m_s > converged_m_s) ++counts_.not_converged;
  if (change_m_s > diverged_m_s) clear_impulses();
}

void BoxWorld::clear_impulses() {
  for (ContactManifold* manifold : touching_) manifold->clear_impulses();
}

// @return the largest change of a point's velocity in the last sweep, m/s
double BoxWorld::run_sweeps(bool accelerated) {
  for (ContactManifold* manifold : touching_) manifold->begin_sweeps();
  for (Body& body : bodies_) body.step.begin_sweeps();
  last_energy_j_ = 0;
  double change_m_s = 0;
  for (int i = 0; i < max_sweeps; ++i) {
    if (i > 0 && accelerated) accelerate();
    change_m_s = 0;
    for (ContactManifold* manifold : touching_)
      change_m_s = std::max(change_m_s, manifold->sweep());
    if (change_m_s <= converged_m_s) break;
  }
  return change_m_s;
}

// Anderson mixing (1965) with one step of memory. Slow convergence is along one direction, each
// change a constant part of the last one: velocities and impulses are extrapolated to where the
// change would have the least kinetic energy. Velocities are linear in the impulses, so the same
// fraction keeps both consistent. The result is that of the last sweep, without extrapolation.
void BoxWorld::accelerate() {
  double energy_j = 0, product_j = 0;
  for (Body& body : bodies_) {
    Motion& motion = body.step;
    if (body.asleep || !(motion.inverse_mass > 0)) continue;
    const Velocity last = motion.sweep_change;
    motion.sweep_change = {motion.constrained.linear_m_s - motion.sweep_start.linear_m_s,
                           motion.constrained.angular_rad_s - motion.sweep_start.angular_rad_s};
    const double mass_kg = 1 / motion.inverse_mass;
    const double inertia = motion.rotates ? 1 / motion.inverse_inertia.diagonal().maxCoeff() : 0;
    const auto& [along, about] = motion.sweep_change;
    energy_j += mass_kg * along.squaredNorm() + inertia * about.squaredNorm();
    product_j += mass_kg * along.dot(last.linear_m_s) + inertia * about.dot(last.angular_rad_s);
  }
  const double denominator_j = energy_j + last_energy_j_ - 2 * product_j;
  const bool known = last_energy_j_ > 0 && denominator_j > 0;
  const double fraction =
      known ? std::clamp((product_j - energy_j) / denominator_j, 0.0, max_extrapolation) : 0;
  last_energy_j_ = energy_j;
  for (Body& body : bodies_)
    if (!body.asleep) body.step.extrapolate_sweep(fraction);
  for (ContactManifold* manifold : touching_) manifold->extrapolate_sweep(fraction);
}

}  // namespace heft::boxes
