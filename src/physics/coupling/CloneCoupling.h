// The coupling law on all axes of a clone: before a step it says with which mass and velocity the
// clone goes into the contact solver, after it it takes note of what the contacts made of them.
#pragma once

#include <array>

#include "physics/coupling/CouplingLaw.h"
#include "physics/scene/Scene.h"
#include "physics/scene/WorldState.h"

namespace heft {

/// What the contact solver has to work with in one step.
struct CoupledClone {
  Velocity velocity;  ///< at which the clone moves if nothing touches it
  double mass_kg = 0;
  Eigen::Vector3d inertia_kg_m2 = Eigen::Vector3d::Zero();  ///< own axes; zero: nothing turns it
};

class CloneCoupling {
 public:
  CloneCoupling() = default;

  /// @param locked the clone turns exactly as the effector does
  CloneCoupling(CouplingScheme scheme, const Scene& scene, bool locked);

  bool locked() const { return locked_; }

  /// Forgets the past: clone and target move at these velocities.
  void restart(const BodyState& clone, const Velocity& target_velocity);

  /// Starts a step in which the target moves from one pose to another.
  CoupledClone begin(const Pose& clone, const Pose& from, const Pose& to, double h_s);

  /// Ends it: the clone as the contact solver left it.
  void end(const BodyState& clone);

 private:
  void begin_turn(const Pose& clone, const Pose& from, const Velocity& of_target, double h_s,
                  CoupledClone& free);

  bool locked_ = true;
  std::array<CouplingLaw, 3> translation_, rotation_;  // world axes, the clone's own axes
};

}  // namespace heft
