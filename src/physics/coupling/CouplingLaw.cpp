#include "physics/coupling/CouplingLaw.h"

#include <cmath>

namespace heft {

CouplingLaw::Sampled CouplingLaw::sampled(const CouplingAxis& axis, double h_s) {
  const double omega = std::sqrt(axis.stiffness / axis.mass), z = axis.damping_ratio;
  const double x = z * omega * h_s;
  const double y = omega * h_s * std::sqrt(std::abs(z * z - 1));
  const double e = std::exp(-x), d = std::exp(-2 * x);
  if (y < 1e-4) {  // y is divided by: the first terms of the series, exact to the last bit
    const double bend = z < 1 ? -y * y : y * y;
    const double a = std::expm1(-x) * std::expm1(-x) - e * bend * (1 + bend / 12);
    return {e * (1 + bend / 2), e * h_s * (1 + bend / 6), d, a, z * omega, z < 1 ? y : 0};
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
  if (h_s * std::sqrt(k / m) < 0.01) {  // the differences below are lost in rounding
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
  if (std::abs(h_s - sampled_h_s_) <= 1e-12 * h_s) return;  // a difference of times rounds
  now_ = sampled(axis_, h_s);
  sampled_h_s_ = h_s;
}

void CouplingLaw::restart(double clone_velocity, double target_velocity) {
  velocity_ = clone_velocity;
  target_velocity_ = target_velocity;
  last_h_s_ = load_ = sampled_h_s_ = 0;
}

// d w, for a step whose length may differ from the last one's: w is then what the mean velocity
// over the last h_s seconds would have been on the same free path around the loaded rest point.
double CouplingLaw::memory(double offset, double h_s) const {
  const double w = velocity_ - target_velocity_;
  if (std::abs(h_s - last_h_s_) <= 1e-9 * h_s) return now_.d * w;
  const double r = offset - load_ / axis_.stiffness;
  double r_velocity = w;
  if (last_h_s_ > 0) {
    const Sampled last = sampled(axis_, last_h_s_);
    // Fewer than three samples an oscillation, or a spring that has long come to rest within a
    // step: two positions do not tell the momentary velocity.
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

}  // namespace heft
