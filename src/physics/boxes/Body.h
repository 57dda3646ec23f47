// One box of a BoxWorld: where it is, how fast at this moment, and what a push does to it in a
// step.
#pragma once

#include <array>

#include "physics/BoxContacts.h"

namespace heft::boxes {

/// The two ends of a step that contacts are solved for: the mean velocity over it, which says where
/// bodies get to, and the velocity at its end.
enum Level { mean = 0, end = 1 };
inline constexpr std::array<Level, 2> both_levels{mean, end};

/// A body's velocity at one level, and how contacts' impulses over the step change it.
struct Motion {
  Velocity velocity;
  double per_kg = 0;  ///< 0: nothing pushes it
  Eigen::Matrix3d per_kg_m2 = Eigen::Matrix3d::Zero();
  bool turns = false;  ///< false: nothing turns it
  // Of the last sweep: what it started from, changed by, and ended with.
  Velocity start{}, change{}, swept{};

  void begin_sweeps() {
    start = swept = velocity;
    change = {};
  }
  /// Beyond the last sweep's end, by a share of its distance from the end of the one before.
  void go_on(double share) {
    start = {velocity.linear_m_s + share * (velocity.linear_m_s - swept.linear_m_s),
             velocity.angular_rad_s + share * (velocity.angular_rad_s - swept.angular_rad_s)};
    swept = velocity;
    velocity = start;
  }
  void push(const Eigen::Vector3d& impulse_n_s, const Eigen::Vector3d& moment_n_m_s) {
    velocity.linear_m_s += per_kg * impulse_n_s;
    if (turns) velocity.angular_rad_s += per_kg_m2 * moment_n_m_s;
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
  double at_rest_s = 0;        ///< for how long it has not moved noticeably
  std::array<Motion, 2> step;  ///< by Level, of the step under way
  /// What pushes change the mean velocity by changes that at the end by this share, beside what the
  /// end's own do: pushes grow or fade over a step, and a coupled body feels early ones less.
  double mean_to_end = 0;
  Velocity free_mean;  ///< before contacts

  bool moves() const { return solid && !asleep; }
  void set_size(const Eigen::Vector3d& size_m);
  /// At this pose and velocity, awake.
  void put(const Pose& to, const Velocity& at);
  /// Sets the pose alone.
  void place(const Pose& at);
  /// Goes on at a mean velocity for h_s seconds.
  void move(const Velocity& at, double h_s);
  /// What it does in h_s seconds under its weight if nothing touches it; 0: pushes act at once.
  /// @param momentary false: as if all that changes its velocity came at the start
  void fall(double gravity_m_s2, double h_s, bool momentary);
  /// From the mean velocity that contacts made to the one at the end.
  void carry_over() {
    step[end].velocity.linear_m_s +=
        mean_to_end * (step[mean].velocity.linear_m_s - free_mean.linear_m_s);
  }
  void carry_nothing() {
    step[end].per_kg += mean_to_end * step[mean].per_kg;
    mean_to_end = 0;
  }
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
