#include "physics/push/Oscillation.h"

#include <cmath>

namespace heft {

Oscillation::Oscillation(double mass, double damping, double stiffness)
    : omega_(std::sqrt(stiffness / mass)), decay_(damping / (2 * mass)) {
  const double squared = decay_ * decay_ - omega_ * omega_;
  split_ = std::sqrt(std::abs(squared));
  rings_ = squared < 0;
}

Oscillation::Passed Oscillation::passed(double t_s) const {
  const double x = split_ * t_s;
  if (x < 1e-5) {
    const double even = std::exp(-decay_ * t_s);
    return {t_s, even, even * t_s};
  }
  if (rings_) {
    const double e = std::exp(-decay_ * t_s);
    return {t_s, e * std::cos(x), e * std::sin(x) / split_};
  }
  const double slow = std::exp(x - decay_ * t_s), fast = std::exp(-x - decay_ * t_s);
  return {t_s, (slow + fast) / 2, (slow - fast) / 2 / split_};
}

Oscillation::At Oscillation::after(double t_s, double y, double speed) const {
  constexpr double same = 1e-13;  // a difference of two times rounds
  if (std::abs(t_s - last_.t_s) > same * t_s) last_ = passed(t_s);
  const double now = y * last_.even + (speed + decay_ * y) * last_.odd;
  const double now_speed = speed * last_.even - (decay_ * speed + omega_ * omega_ * y) * last_.odd;
  return {now, now_speed, -2 * decay_ * now_speed - omega_ * omega_ * now};
}

}  // namespace heft
