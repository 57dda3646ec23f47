// The coupling law on all axes of a clone: before a step it gives the clone the mass and the
// velocity that a contact solver needs, after it it takes note of what the contacts made of them.
#pragma once

#include <array>

#include "physics/CouplingLaw.h"
#include "physics/Scene.h"
#include "physics/boxes/Body.h"

namespace heft::boxes {

/// mean_velocity (base/Pose.h), quicker where nothing turns.
Velocity mean_velocity_of(const Pose& from, const Pose& to, double dt_s);

class CloneCoupling {
 public:
  CloneCoupling() = default;
  explicit CloneCoupling(const Scene& scene);

  /// Whether the clone turns exactly as the effector does. So it does where the torsional spring is
  /// so much stiffer than the other that turning adds nothing to the lag, unless it is released
  /// turned away.
  bool locked() const { return locked_; }

  /// Forgets the past: clone and target move at these velocities.
  void restart(const Body& clone, const Velocity& clone_velocity, const Velocity& target_velocity);

  /// Starts a step in which the target moves from one pose to another.
  void begin(Body& clone, const Pose& from, const Pose& to, double h_s);

  /// Ends it.
  void end(Body& clone, const Pose& to);

 private:
  void begin_turn(Body& clone, const Pose& from, const Velocity& of_target, double h_s);

  bool locked_ = true;
  std::array<CouplingLaw, 3> translation_, rotation_;  // world axes, the clone's own axes
  Eigen::Vector3d solver_inertia_kg_m2_ = Eigen::Vector3d::Zero();
};

}  // namespace heft::boxes
