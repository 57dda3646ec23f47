// A damped oscillator about its rest point, in closed form: m y'' + c y' + k y = 0.
#pragma once

namespace heft {

class Oscillation {
 public:
  struct At {
    double y, speed, acceleration;
  };

  Oscillation() = default;
  /// @param mass m, kg; damping c, N s/m; stiffness k, N/m; all above zero
  Oscillation(double mass, double damping, double stiffness);

  /// t_s seconds after it was at y with this speed.
  At after(double t_s, double y, double speed) const;

  double omega_rad_s() const { return omega_; }

 private:
  double omega_ = 1, decay_ = 1;  ///< sqrt(k / m), c / (2 m)
  // Of the time asked for last: most steps are as long as the one before.
  struct Passed {
    double t_s = -1;
    double even = 1, odd = 0;  // e^(-decay t) times cos or cosh(x), and sin or sinh(x) / split
  };
  Passed passed(double t_s) const;

  mutable Passed last_;
  double split_ = 0;    ///< |decay^2 - omega^2|^(1/2)
  bool rings_ = false;  ///< underdamped
};

}  // namespace heft
