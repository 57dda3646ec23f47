// Closed-form solutions that simulators are tested against.
#pragma once

#include <cmath>
#include <complex>

namespace heft {

/// A damped oscillator released at rest: x'' + 2 z w x' + w^2 x = 0, x(0) = 1, x'(0) = 0, for any
/// damping ratio z. For z = 1: (1 + w t) e^(-w t).
class FreeReturn {
 public:
  FreeReturn(double stiffness, double mass, double damping_ratio)
      : omega_(std::sqrt(stiffness / mass)), z_(damping_ratio) {}

  double omega_rad_s() const { return omega_; }

  /// Offset after t_s as a fraction of the first one.
  double operator()(double t_s) const {
    const double wt = omega_ * t_s;
    if (std::abs(z_ - 1) < 1e-9) return (1 + wt) * std::exp(-wt);
    const std::complex<double> root = std::sqrt(std::complex<double>(z_ * z_ - 1));
    const auto slow = -z_ + root, fast = -z_ - root;
    return ((slow * std::exp(fast * wt) - fast * std::exp(slow * wt)) / (slow - fast)).real();
  }

 private:
  double omega_, z_;
};

/// Force that pushes a sliding cube at a constant velocity.
inline double sliding_force_n(double friction, double mass_kg, double gravity_m_s2 = 9.81) {
  return friction * mass_kg * gravity_m_s2;
}

/// Distance of the clone behind the effector at that force (paper, section 3.2).
inline double steady_lag_m(double friction, double mass_kg, double stiffness_n_per_m) {
  return sliding_force_n(friction, mass_kg) / stiffness_n_per_m;
}

}  // namespace heft
