// One box of a BoxWorld: pose, velocity, and what a push does to it.
#pragma once

#include "physics/BoxContacts.h"

namespace heft::boxes {

struct Body {
  Pose pose;
  Velocity velocity;    ///< mean over the last step
  Box shape;            ///< its size, and `pose` as the contact finder wants it
  double radius_m = 0;  ///< of the sphere around it

  double inverse_mass_per_kg = 0;                             ///< 0: nothing pushes it
  Eigen::Vector3d inertia_kg_m2 = Eigen::Vector3d::Zero();    ///< own axes; 0: nothing turns it
  Eigen::Matrix3d inverse_inertia = Eigen::Matrix3d::Zero();  ///< world axes, 1/(kg m^2)
  bool turns_alike = true;                                    ///< about any axis, as a cube does
  bool tumbles = false;  ///< its moments of inertia differ: it wobbles when it turns freely

  bool solid = true;       ///< false: touches nothing
  bool has_weight = true;  ///< false: driven by the coupling; never sleeps
  bool asleep = false;
  bool fresh = false;  ///< its velocity is momentary, not the mean over a step
  Eigen::Vector3d rate_m_s2 = Eigen::Vector3d::Zero();  ///< at which the last step changed it
  bool pushed = false;                                  ///< by the driven body, or through others
  bool steady = false;                                  ///< the step before changed it alike
  double owed_s = 0;                                    ///< of weight, in the next step
  double calm_s = 0;  ///< for how long it has not moved noticeably

  /// Change of angular velocity by a unit impulse's moment.
  Eigen::Vector3d response(const Eigen::Vector3d& moment) const {
    if (!turns_alike) return inverse_inertia * moment;
    return inverse_inertia(0, 0) * moment;
  }
  void set_size(const Eigen::Vector3d& size);
  /// @param inertia own axes; zero where nothing turns it
  void set_mass(double mass_kg, const Eigen::Vector3d& inertia);
  void put(const Pose& to, const Velocity& at);
  /// Sets the pose alone.
  void place(const Pose& at);
  /// Goes on at its velocity for h_s seconds.
  void move(double h_s);
  /// Moves without a change of velocity.
  void shift(const Eigen::Vector3d& by_m, const Eigen::Vector3d& turn_rad);
  /// The change of angular velocity over h_s seconds in which nothing turns it.
  void tumble(double h_s);
  void wake() {
    asleep = false;
    calm_s = 0;
  }
  /// Upper bound of the speed of any of its points at a velocity, m/s.
  double tip_speed_m_s(const Velocity& at) const {
    const double turn_rad_s = at.angular_rad_s.isZero(0) ? 0 : at.angular_rad_s.norm();
    return at.linear_m_s.norm() + turn_rad_s * radius_m;
  }
  double tip_speed_m_s() const { return tip_speed_m_s(velocity); }

 private:
  void turned();
  void refresh_inertia();
};

}  // namespace heft::boxes
