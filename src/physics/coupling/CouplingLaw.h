// The law that ties the clone to the effector, along one axis, in a form that a contact solver can
// take part in. F = -k d - c v becomes a free velocity and a solver mass for the next step: the
// solver then sees how hard the clone really is to push aside. A force that is only applied before
// the solver is right in free air and wrong in contact.
//
// With e = clone - target at the start of the step, u0 and u1 = the target's mean velocity over the
// last and this step, w = mean velocity of the clone over the last step, less u0:
//   implicit Euler    M = m + h c + h^2 k,   v = u1 + (m (w + u0 - u1) - h k e) / M
//   exact             M = k h^2 / a,         v = u1 + d w - (a / h) e - (b / h) (u1 - u0)
// where d = e^(-2 z w0 h), s = 2 e^(-z w0 h) Re cosh(w0 h sqrt(z^2 - 1)), a = 1 - s + d and the
// impulse response b are those of the sampled oscillator with w0 = sqrt(k/m) and damping ratio z:
// it is exact in free motion, under a steady load, and where the target's velocity steps.
//
// A solver that keeps momentary velocities needs no memory: oscillator_step() is all there is.
#pragma once

#include <array>

#include "physics/scene/Scene.h"

namespace heft {

enum class CouplingScheme { implicit_euler, exact };

/// One axis: metres, kilograms, newtons, or radians, kg m^2 and newton metres.
struct CouplingAxis {
  double mass = 0;
  double stiffness = 0;
  double damping_ratio = 1;
};

/// What the contact solver has to work with in one step.
struct FreeStep {
  double solver_mass = 0;
  double velocity = 0;  ///< at which the clone moves if nothing touches it
};

/// What an axis does by itself, and under a steady force, in a step: exact. Offset and velocity are
/// the clone's against a target that goes straight on; `offset_by_force` is how far 1 N takes it.
struct OscillatorStep {
  double offset_by_offset = 1, offset_by_velocity = 0, offset_by_force = 0;
  double velocity_by_offset = 0, velocity_by_velocity = 1, velocity_by_force = 0;
  /// The same of a force that grows by 1 N/s and is 0 in the middle of the step.
  double offset_by_growth = 0, velocity_by_growth = 0;
};

/// @param h_s above 0
OscillatorStep oscillator_step(const CouplingAxis& axis, double h_s);

class CouplingLaw {
 public:
  CouplingLaw() = default;
  CouplingLaw(CouplingScheme scheme, const CouplingAxis& axis) : scheme_(scheme), axis_(axis) {}

  /// Forgets the past: the clone and the target move at these velocities.
  void restart(double clone_velocity, double target_velocity);

  /// Starts a step of h_s seconds.
  FreeStep begin(double offset, double target_velocity, double h_s);

  /// Ends it: the clone's velocity as the contact solver left it.
  void end(double velocity);

 private:
  // A free oscillator sampled every h seconds: x(h) = (half_trace + z w0 impulse) x(0) + impulse
  // v(0), and x(h) = 2 half_trace x(0) - d x(-h).
  struct Sampled {
    double half_trace = 0, impulse = 0, d = 0, a = 0;
    double decay = 0;  // z w0
    double turn = 0;   // radians of oscillation in h; 0 unless underdamped
  };
  static Sampled sampled(const CouplingAxis& axis, double h_s);
  friend OscillatorStep oscillator_step(const CouplingAxis& axis, double h_s);
  void sample(double h_s);
  double memory(double offset, double h_s) const;

  CouplingScheme scheme_ = CouplingScheme::exact;
  CouplingAxis axis_;
  double velocity_ = 0, target_velocity_ = 0;  ///< over the last step
  double last_h_s_ = 0;                        ///< 0: velocity_ is momentary
  double load_ = 0;                            ///< force on the clone over the last step
  Sampled now_;  ///< for steps of sampled_h_s_: most steps are as long as the last
  double sampled_h_s_ = 0;
  // The step under way:
  FreeStep step_;
  double h_s_ = 0, next_target_velocity_ = 0;
};

/// What the contact solver has to work with in one step.
struct CoupledClone {
  Velocity velocity;  ///< at which the clone moves if nothing touches it
  double mass_kg = 0;
  Eigen::Vector3d inertia_kg_m2 = Eigen::Vector3d::Zero();  ///< own axes; zero: nothing turns it
};

/// The coupling law on all axes of a clone: before a step it says with which mass and velocity the
/// clone goes into the contact solver, after it it takes note of what the contacts made of them.
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
