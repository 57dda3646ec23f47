// A damped oscillator about its rest point in closed form: m y'' + c y' + k y = 0.
#pragma once

#include <cmath>

namespace heft {

class Oscillation {
 public:
  struct At {
    double y = 0, speed = 0, acceleration = 0;
  };

  Oscillation() = default;
  /// @param mass m, kg; damping c, N s/m; stiffness k, N/m; all above zero
  Oscillation(double mass, double damping, double stiffness);

  /// State t_s seconds after offset y and this speed.
  At after(double t_s, double y, double speed) const;

  double omega_rad_s() const { return omega_; }

 private:
  double omega_ = 1, decay_ = 1;  ///< sqrt(k / m), c / (2 m)
  // Factors of the last time, cached because most steps have equal length.
  struct Passed {
    double t_s = -1;
    double even = 1, odd = 0;  // e^(-decay t) times cos or cosh(x), and sin or sinh(x) / split
  };
  Passed passed(double t_s) const;

  mutable Passed last_;
  double split_ = 0;    ///< |decay^2 - omega^2|^(1/2)
  bool rings_ = false;  ///< underdamped
};

inline Oscillation::At Oscillation::after(double t_s, double y, double speed) const {
  constexpr double same = 1e-13;  // rounding of time differences
  if (std::abs(t_s - last_.t_s) > same * t_s) last_ = passed(t_s);
  const double now = y * last_.even + (speed + decay_ * y) * last_.odd;
  const double now_speed = speed * last_.even - (decay_ * speed + omega_ * omega_ * y) * last_.odd;
  return {now, now_speed, -2 * decay_ * now_speed - omega_ * omega_ * now};
}

inline Oscillation::Oscillation(double mass, double damping, double stiffness)
    : omega_(std::sqrt(stiffness / mass)), decay_(damping / (2 * mass)) {
  const double squared = decay_ * decay_ - omega_ * omega_;
  split_ = std::sqrt(std::abs(squared));
  rings_ = squared < 0;
}

inline Oscillation::Passed Oscillation::passed(double t_s) const {
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
