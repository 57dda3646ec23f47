#include "physics/coupling/CouplingLaw.h"

#include <fmt/format.h>

#include <cmath>

#include "base/Pose.h"

namespace heft {

namespace {
constexpr double stable_damping_ratio = 0.1, stable_phase_rad = 12;
}

std::optional<std::string> instability(const Coupling& coupling, double rate_hz) {
  if (!coupling.decoupled || coupling.damping_ratio >= stable_damping_ratio) return std::nullopt;
  const double omega_rad_s = std::sqrt(coupling.stiffness_n_per_m / coupling.clone_mass_kg);
  const double least_hz = std::ceil(omega_rad_s / stable_phase_rad);
  if (rate_hz >= least_hz) return std::nullopt;
  return fmt::format(
      "damping_ratio is {:g}: the clone oscillates {:.3g} times a second and loses so little "
      "energy "
      "that contacts are unstable at {:g} steps a second; expected a damping_ratio of {:g} or "
      "more, "
      "or at least {:g} steps a second",
      coupling.damping_ratio, omega_rad_s / (2 * M_PI), rate_hz, stable_damping_ratio, least_hz);
}

CouplingLaw::Sampled CouplingLaw::sampled(const CouplingAxis& axis, double h_s) {
  const double omega = std::sqrt(axis.stiffness / axis.mass), z = axis.damping_ratio;
  const double x = z * omega * h_s;
  const double y = omega * h_s * std::sqrt(std::abs(z * z - 1));
  const double e = std::exp(-x), d = std::exp(-2 * x);
  if (y < 1e-4) {  // avoids a division by y; these terms of the series are exact to the last bit
    const double square = z < 1 ? -y * y : y * y;
    const double a = std::expm1(-x) * std::expm1(-x) - e * square * (1 + square / 12);
    return {e * (1 + square / 2), e * h_s * (1 + square / 6), d, a, z * omega, z < 1 ? y : 0};
  }
  if (z < 1) {
    const double a = std::expm1(-x) * std::expm1(-x) + 4 * e * std::pow(std::sin(y / 2), 2);
    return {e * std::cos(y), e * std::sin(y) * h_s / y, d, a, z * omega, y};
  }
  const double slow = std::exp(y - x), fast = std::exp(-y - x);
  return {(slow + fast) / 2,
          (slow - fast) / 2 * h_s / y,
          d,
          std::expm1(y - x) * std::expm1(-y - x),
          z * omega,
          0};
}

OscillatorStep oscillator_step(const CouplingAxis& axis, double h_s) {
  const auto [half_trace, impulse, d, a, decay, turn] = CouplingLaw::sampled(axis, h_s);
  const double k = axis.stiffness, m = axis.mass, damping_s = 2 * decay * m / k;
  const double lost = (a - std::expm1(-2 * decay * h_s)) / 2 - decay * impulse;
  OscillatorStep step;
  step.offset_by_offset = 1 - lost;
  step.offset_by_velocity = impulse;
  step.offset_by_force = lost / k;
  step.velocity_by_offset = -k / m * impulse;
  step.velocity_by_velocity = half_trace - decay * impulse;
  step.velocity_by_force = impulse / m;
  if (h_s * std::sqrt(k / m) < 0.01) {  // series, where the differences below cancel
    step.offset_by_growth = -h_s * h_s * h_s / (12 * m);
    step.velocity_by_growth = decay * h_s * h_s * h_s / (6 * m);
  } else {
    step.offset_by_growth = (h_s - impulse - lost * (damping_s + h_s / 2)) / k;
    step.velocity_by_growth =
        (1 - step.velocity_by_velocity + step.velocity_by_offset * (damping_s + h_s / 2)) / k;
  }
  return step;
}

void CouplingLaw::sample(double h_s) {
  if (std::abs(h_s - sampled_h_s_) <= 1e-12 * h_s) return;  // rounding of time differences
  now_ = sampled(axis_, h_s);
  sampled_h_s_ = h_s;
}

void CouplingLaw::restart(double clone_velocity, double target_velocity) {
  velocity_ = clone_velocity;
  target_velocity_ = target_velocity;
  last_h_s_ = load_ = sampled_h_s_ = 0;
}

// d w, for a step whose length may differ from the last one's. w is then the mean velocity over the
// last h_s seconds of the free motion about the loaded rest point.
double CouplingLaw::memory(double offset, double h_s) const {
  const double w = velocity_ - target_velocity_;
  if (std::abs(h_s - last_h_s_) <= 1e-9 * h_s) return now_.d * w;
  const double r = offset - load_ / axis_.stiffness;
  double r_velocity = w;
  if (last_h_s_ > 0) {
    const Sampled last = sampled(axis_, last_h_s_);
    // With fewer than three samples an oscillation, or a spring that comes to rest within a step,
    // two positions do not determine the instantaneous velocity.
    if (last.turn > 2 || last.impulse < 1e-200) return now_.d * w;
    r_velocity =
        (r * (last.half_trace - last.decay * last.impulse) - last.d * (r - last_h_s_ * w)) /
        last.impulse;
  }
  return (r * (now_.d - now_.half_trace + now_.decay * now_.impulse) + r_velocity * now_.impulse) /
         h_s;
}

FreeStep CouplingLaw::begin(double offset, double target_velocity, double h_s) {
  const double m = axis_.mass, k = axis_.stiffness, u = target_velocity;
  if (scheme_ == CouplingScheme::implicit_euler) {
    const double c = axis_.damping_ratio * 2 * std::sqrt(k * m);
    step_.solver_mass = m + h_s * c + h_s * h_s * k;
    step_.velocity = u + (m * (velocity_ - u) - h_s * k * offset) / step_.solver_mass;
  } else {
    sample(h_s);
    const double a = now_.a;
    step_.solver_mass = k * h_s * h_s / a;
    step_.velocity =
        u + memory(offset, h_s) - a / h_s * offset - now_.impulse / h_s * (u - target_velocity_);
  }
  h_s_ = h_s;
  next_target_velocity_ = u;
  return step_;
}

void CouplingLaw::end(double velocity) {
  load_ = step_.solver_mass * (velocity - step_.velocity) / h_s_;
  velocity_ = velocity;
  target_velocity_ = next_target_velocity_;
  last_h_s_ = h_s_;
}

using Eigen::Vector3d;

CloneCoupling::CloneCoupling(CouplingScheme scheme, const Scene& scene, bool locked)
    : locked_(locked) {
  const Coupling& coupling = scene.coupling;
  const double m = coupling.clone_mass_kg, z = coupling.damping_ratio;
  const Vector3d inertia = box_inertia_kg_m2(m, scene.effector_size_m);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto e = static_cast<Eigen::Index>(i);
    translation_[i] = {scheme, {m, coupling.stiffness_n_per_m, z}};
    rotation_[i] = {scheme, {inertia[e], coupling.torsional_stiffness_nm_per_rad, z}};
  }
}

void CloneCoupling::restart(const BodyState& clone, const Velocity& target_velocity) {
  const auto own = clone.pose.orientation.conjugate();
  const Vector3d own_turn = own * clone.velocity.angular_rad_s;
  const Vector3d own_target_turn = own * target_velocity.angular_rad_s;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto e = static_cast<Eigen::Index>(i);
    translation_[i].restart(clone.velocity.linear_m_s[e], target_velocity.linear_m_s[e]);
    rotation_[i].restart(own_turn[e], own_target_turn[e]);
  }
}

CoupledClone CloneCoupling::begin(const Pose& clone, const Pose& from, const Pose& to, double h_s) {
  const Velocity of_target = mean_velocity(from, to, h_s);
  const Vector3d offset_m = clone.position_m - from.position_m;
  CoupledClone free;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto e = static_cast<Eigen::Index>(i);
    const FreeStep step = translation_[i].begin(offset_m[e], of_target.linear_m_s[e], h_s);
    free.mass_kg = step.solver_mass;
    free.velocity.linear_m_s[e] = step.velocity;
  }
  if (locked_)
    free.velocity.angular_rad_s = mean_velocity(clone, to, h_s).angular_rad_s;
  else
    begin_turn(clone, from, of_target, h_s, free);
  return free;
}

void CloneCoupling::begin_turn(const Pose& clone, const Pose& from, const Velocity& of_target,
                               double h_s, CoupledClone& free) {
  const auto& own = clone.orientation;
  const Vector3d offset_rad = rotation_vector(from.orientation.conjugate() * own);
  const Vector3d target_turn = own.conjugate() * of_target.angular_rad_s;
  Vector3d turn;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto e = static_cast<Eigen::Index>(i);
    const FreeStep step = rotation_[i].begin(offset_rad[e], target_turn[e], h_s);
    free.inertia_kg_m2[e] = step.solver_mass;
    turn[e] = step.velocity;
  }
  free.velocity.angular_rad_s = own * turn;
}

void CloneCoupling::end(const BodyState& clone) {
  const Vector3d turn = clone.pose.orientation.conjugate() * clone.velocity.angular_rad_s;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto e = static_cast<Eigen::Index>(i);
    translation_[i].end(clone.velocity.linear_m_s[e]);
    if (!locked_) rotation_[i].end(turn[e]);
  }
}

}  // namespace heft
