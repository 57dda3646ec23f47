#include "physics/CouplingLaw.h"

#include <cmath>

namespace heft {

namespace {
// A free oscillator sampled every h seconds: x(h) = (half_trace + z w0 impulse) x(0) + impulse
// v(0), and x(h) = 2 half_trace x(0) - d x(-h).
struct Sampled {
  double half_trace, impulse, d, a;
  double decay;  // z w0
  double turn;   // radians of oscillation in h; 0 unless underdamped
};

Sampled sampled(const CouplingAxis& axis, double h_s) {
  const double omega = std::sqrt(axis.stiffness / axis.mass), z = axis.damping_ratio;
  const double x = z * omega * h_s;
  const double y = omega * h_s * std::sqrt(std::abs(z * z - 1));
  const double e = std::exp(-x), d = std::exp(-2 * x);
  if (y < 1e-4)  // sinh(y) / y and sin(y) / y are 1 to the last bit that matters
    return {e, e * h_s, d, std::expm1(-x) * std::expm1(-x), z * omega, 0};
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
}  // namespace

void CouplingLaw::restart(double clone_velocity, double target_velocity) {
  velocity_ = clone_velocity;
  target_velocity_ = target_velocity;
  last_h_s_ = load_ = 0;
}

// d w, for a step whose length may differ from the last one's: w is then what the mean velocity
// over the last h_s seconds would have been on the same free path around the loaded rest point.
double CouplingLaw::memory(double offset, double h_s) const {
  const Sampled now = sampled(axis_, h_s);
  const double w = velocity_ - target_velocity_;
  if (std::abs(h_s - last_h_s_) <= 1e-9 * h_s) return now.d * w;
  const double r = offset - load_ / axis_.stiffness;
  double r_velocity = w;
  if (last_h_s_ > 0) {
    const Sampled last = sampled(axis_, last_h_s_);
    // Fewer than three samples an oscillation, or a spring that has long come to rest within a
    // step: two positions do not tell the momentary velocity.
    if (last.turn > 2 || last.impulse < 1e-200) return now.d * w;
    r_velocity =
        (r * (last.half_trace - last.decay * last.impulse) - last.d * (r - last_h_s_ * w)) /
        last.impulse;
  }
  return (r * (now.d - now.half_trace + now.decay * now.impulse) + r_velocity * now.impulse) / h_s;
}

FreeStep CouplingLaw::begin(double offset, double target_velocity, double h_s) {
  const double m = axis_.mass, k = axis_.stiffness, u = target_velocity;
  if (scheme_ == CouplingScheme::implicit_euler) {
    const double c = axis_.damping_ratio * 2 * std::sqrt(k * m);
    step_.solver_mass = m + h_s * c + h_s * h_s * k;
    step_.velocity = u + (m * (velocity_ - u) - h_s * k * offset) / step_.solver_mass;
  } else {
    const double a = sampled(axis_, h_s).a;
    step_.solver_mass = k * h_s * h_s / a;
    step_.velocity =
        u + memory(offset, h_s) - a / h_s * offset - m / step_.solver_mass * (u - target_velocity_);
  }
  h_s_ = h_s;
  next_target_velocity_ = u;
  return step_;
}

void CouplingLaw::end(double velocity) {
  const double contact = step_.solver_mass * (velocity - step_.velocity) / h_s_;
  load_ = contact - axis_.mass * (next_target_velocity_ - target_velocity_) / h_s_;
  velocity_ = velocity;
  target_velocity_ = next_target_velocity_;
  last_h_s_ = h_s_;
}

}  // namespace heft
