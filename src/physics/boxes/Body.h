// A rigid box of a BoxWorld and its motion over one step.
#pragma once

#include "physics/scene/BoxContacts.h"

namespace heft::boxes {

/// Length of a step and lookahead of its contacts. Contacts constrain the weighted mean of a body's
/// mean velocity over the step and its velocity at the end; see ContactSolver.cpp.
struct StepTime {
  double h_s = 0, lookahead_s = 0;
  double mean_weight() const { return h_s > 0 ? h_s / (h_s + lookahead_s) : 0; }
};

/// A body's motion over a step with constant contact forces.
struct Motion {
  Velocity mean, end;          ///< without contacts before finish(), with contacts after
  Velocity constrained, free;  ///< weighted means of these, with and without contact impulses
  // Response of `constrained` to an impulse, and of `mean` to a change of `constrained`.
  double inverse_mass = 0;  ///< 1/kg; 0: impulses do not move it
  Eigen::Matrix3d inverse_inertia = Eigen::Matrix3d::Zero();
  bool rotates = false;  ///< false: impulses do not rotate it
  double mean_per_constrained = 0;
  Eigen::Matrix3d mean_rotation_per_constrained = Eigen::Matrix3d::Zero();  ///< of driven bodies
  // Velocities of the last sweep, for BoxWorld::accelerate().
  Velocity sweep_start{}, sweep_change{}, sweep_end{};

  /// Sets `free` and `constrained` from `mean` and `end`.
  void begin(double mean_weight);
  void apply_impulse(const Eigen::Vector3d& impulse_n_s, const Eigen::Vector3d& moment_n_m_s) {
    constrained.linear_m_s += inverse_mass * impulse_n_s;
    if (rotates) constrained.angular_rad_s += inverse_inertia * moment_n_m_s;
  }
  /// Sets `mean` and `end` from the solved `constrained`.
  void finish(double mean_weight, bool driven);

  void begin_sweeps() {
    sweep_start = sweep_end = constrained;
    sweep_change = {};
  }
  /// Extrapolates by a fraction of the difference between the ends of the last two sweeps.
  void extrapolate_sweep(double fraction) {
    sweep_start = {
        constrained.linear_m_s + fraction * (constrained.linear_m_s - sweep_end.linear_m_s),
        constrained.angular_rad_s +
            fraction * (constrained.angular_rad_s - sweep_end.angular_rad_s)};
    sweep_end = constrained;
    constrained = sweep_start;
  }
};

struct Body {
  Pose pose;
  Velocity velocity;    ///< at the current time
  Box shape;            ///< size and pose for contact detection
  double radius_m = 0;  ///< of the bounding sphere
  double mass_kg = 0;
  Eigen::Vector3d inertia_kg_m2 = Eigen::Vector3d::Zero();  ///< about its axes
  std::optional<double> table_friction;                     ///< on the table; none: the world's

  bool solid = true;    ///< false: touches nothing
  bool driven = false;  ///< by the coupling: weightless, never asleep
  bool asleep = false;
  double travel_bound_m = 0;  ///< of its points in the current step
  double at_rest_s = 0;       ///< time since it last moved noticeably
  Motion step;                ///< the current step
  // Mean contact force on a driven body over its last step and that step's length; 0: unknown.
  Eigen::Vector3d mean_force_n = Eigen::Vector3d::Zero();
  double force_duration_s = 0;
  Velocity lead_velocity;  ///< of the last look_ahead()

  bool is_active() const { return solid && !asleep; }
  void set_size(const Eigen::Vector3d& size_m);
  /// Sets pose and velocity and wakes the body.
  void reset(const Pose& to, const Velocity& at);

  void set_pose(const Pose& at);
  /// Moves at a constant velocity for h_s seconds.
  void integrate(const Velocity& at, double h_s);
  /// Sets the motion under gravity, without contacts.
  void set_free_motion(double gravity_m_s2, const StepTime& time);
  /// Moves ahead at the current velocity, for contacts as they will be in the middle of a step; not
  /// if asleep or by 0 s.
  void look_ahead(double ahead_s);
  void end_look_ahead();
  void wake() {
    asleep = false;
    at_rest_s = 0;
  }
  /// Upper bound of the speed of its points, m/s.
  double point_speed_bound_m_s(const Velocity& at) const {
    const double turn_rad_s = at.angular_rad_s.isZero(0) ? 0 : at.angular_rad_s.norm();
    return at.linear_m_s.norm() + turn_rad_s * radius_m;
  }

 private:
  Eigen::Vector3d gyroscopic_change(double h_s) const;

  bool looks_ahead_ = false;
  Pose pose_before_;  // of look_ahead()
  Box shape_before_;
};

}  // namespace heft::boxes
