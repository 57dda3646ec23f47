// One box of a BoxWorld: where it is, how fast at this moment, and what pushes do to it in a step.
#pragma once

#include "physics/scene/BoxContacts.h"

namespace heft::boxes {

/// How long a step is and how far contacts look beyond its end: they are solved for velocities that
/// are by this weight the mean over the step and else those at its end, as if nothing pushed from
/// there on. See BoxWorld.h.
struct StepTime {
  double h_s = 0, beyond_s = 0;
  double mean_weight() const { return h_s > 0 ? h_s / (h_s + beyond_s) : 0; }
};

/// A body's motion over a step in which pushes are steady.
struct Motion {
  Velocity mean, end;    ///< without contacts; after finish() with them
  Velocity ahead, free;  ///< what contacts are solved for, with and without them
  // What an impulse changes `ahead` by, and that the mean.
  double per_kg = 0;  ///< 0: nothing pushes it
  Eigen::Matrix3d per_kg_m2 = Eigen::Matrix3d::Zero();
  bool turns = false;  ///< false: nothing turns it
  double mean_by_ahead = 0;
  Eigen::Matrix3d mean_turn_by_ahead = Eigen::Matrix3d::Zero();  ///< of a driven body that turns
  // Of the last sweep: what it started from, changed by, and ended with.
  Velocity start{}, change{}, swept{};

  /// Before contacts, from `mean` and `end`.
  void begin(double mean_weight);
  void push(const Eigen::Vector3d& impulse_n_s, const Eigen::Vector3d& moment_n_m_s) {
    ahead.linear_m_s += per_kg * impulse_n_s;
    if (turns) ahead.angular_rad_s += per_kg_m2 * moment_n_m_s;
  }
  void finish(double mean_weight, bool driven);

  void begin_sweeps() {
    start = swept = ahead;
    change = {};
  }
  /// Beyond the last sweep's end, by a fraction of its distance from the end of the one before.
  void go_on(double fraction) {
    start = {ahead.linear_m_s + fraction * (ahead.linear_m_s - swept.linear_m_s),
             ahead.angular_rad_s + fraction * (ahead.angular_rad_s - swept.angular_rad_s)};
    swept = ahead;
    ahead = start;
  }
};

struct Body {
  Pose pose;
  Velocity velocity;    ///< of this moment
  Box shape;            ///< its size, and `pose` as the contact finder wants it
  double radius_m = 0;  ///< of the sphere around it
  double mass_kg = 0;
  Eigen::Vector3d inertia_kg_m2 = Eigen::Vector3d::Zero();  ///< own axes

  bool solid = true;    ///< false: touches nothing
  bool driven = false;  ///< by the coupling: has no weight, never sleeps
  bool asleep = false;
  double reach_m = 0;    ///< how far it may get in the step under way
  double at_rest_s = 0;  ///< for how long it has not moved noticeably
  Motion step;           ///< under way
  // Of a driven body, the mean force on it over the last step, and how long that was; 0: unknown.
  Eigen::Vector3d pushed_n = Eigen::Vector3d::Zero();
  double pushed_s = 0;

  bool moves() const { return solid && !asleep; }
  void set_size(const Eigen::Vector3d& size_m);
  /// At this pose and velocity, awake.
  void put(const Pose& to, const Velocity& at);
  /// Sets the pose alone.
  void place(const Pose& at);
  /// Goes on at a mean velocity for h_s seconds.
  void move(const Velocity& at, double h_s);
  /// What it does under its weight if nothing touches it.
  void fall(double gravity_m_s2, const StepTime& time);
  void wake() {
    asleep = false;
    at_rest_s = 0;
  }
  /// Upper bound of the speed of any of its points at a velocity, m/s.
  double tip_speed_m_s(const Velocity& at) const {
    const double turn_rad_s = at.angular_rad_s.isZero(0) ? 0 : at.angular_rad_s.norm();
    return at.linear_m_s.norm() + turn_rad_s * radius_m;
  }

 private:
  Eigen::Vector3d tumbled(double h_s) const;
};

}  // namespace heft::boxes
