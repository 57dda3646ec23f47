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

}  // namespace heft
