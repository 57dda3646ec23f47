#include "physics/push/Oscillation.h"

#include <cmath>

namespace heft {

Oscillation::Oscillation(double mass, double damping, double stiffness)
    : omega_(std::sqrt(stiffness / mass)), decay_(damping / (2 * mass)) {
  const double squared = decay_ * decay_ - omega_ * omega_;
  split_ = std::sqrt(std::abs(squared));
  rings_ = squared < 0;
}

Oscillation::At Oscillation::after(double t_s, double y, double speed) const {
  const double slope = speed + decay_ * y;
  const double x = split_ * t_s;
  double even, odd;  // e^(-decay t) times cos or cosh(x), and sin or sinh(x) / split
  if (x < 1e-5) {
    even = std::exp(-decay_ * t_s);
    odd = even * t_s;
  } else if (rings_) {
    const double e = std::exp(-decay_ * t_s);
    even = e * std::cos(x);
    odd = e * std::sin(x) / split_;
  } else {
    const double slow = std::exp(x - decay_ * t_s), fast = std::exp(-x - decay_ * t_s);
    even = (slow + fast) / 2;
    odd = (slow - fast) / 2 / split_;
  }
  const double now = y * even + slope * odd;
  const double now_speed = speed * even - (decay_ * speed + omega_ * omega_ * y) * odd;
  return {now, now_speed, -2 * decay_ * now_speed - omega_ * omega_ * now};
}

}  // namespace heft
