// The coupling of the clone to the effector, along one axis and for all axes, in a form that a
// contact solver can use. The force F = -k d - c v becomes a free velocity and a solver mass for
// the next step, so that the solver sees the clone's impedance. A force applied before the solver
// is exact in free motion and wrong in contact.
//
// Let e = clone - target at the start of the step, u0 and u1 the target's mean velocities over the
// last and this step, and w the clone's mean velocity over the last step minus u0:
//   implicit Euler    M = m + h c + h^2 k,   v = u1 + (m (w + u0 - u1) - h k e) / M
//   exact             M = k h^2 / a,         v = u1 + d w - (a / h) e - (b / h) (u1 - u0)
// with d = e^(-2 z w0 h), s = 2 e^(-z w0 h) Re cosh(w0 h sqrt(z^2 - 1)), a = 1 - s + d and the
// impulse response b of the sampled oscillator, w0 = sqrt(k/m), damping ratio z. This is exact in
// free motion, under a constant load, and where the target's velocity steps.
//
// A solver with instantaneous velocities needs no memory and uses oscillator_step().
#pragma once

#include <array>
#include <optional>
#include <string>

#include "physics/scene/Scene.h"

namespace heft {

/// Why contacts of this clone are unstable at a physics rate, and what to change; none: they are
/// not. A clone that oscillates often in a step and loses little of its energy gains energy from
/// contacts, which are resolved at most 32 times a step (results/physics/stability.svg).
std::optional<std::string> instability(const Coupling& coupling, double rate_hz);

enum class CouplingScheme { implicit_euler, exact };

/// One axis, in meters, kilograms and newtons, or in radians, kg m^2 and newton meters.
struct CouplingAxis {
  double mass = 0;
  double stiffness = 0;
  double damping_ratio = 1;
};

/// Inputs of the contact solver for one step along one axis.
struct FreeStep {
  double solver_mass = 0;
  double velocity = 0;  ///< of the clone without contacts
};

/// Exact response of one axis over a step: of offset and velocity, relative to a target at constant
/// velocity, to their start values and to a constant force of 1 N.
struct OscillatorStep {
  double offset_by_offset = 1, offset_by_velocity = 0, offset_by_force = 0;
  double velocity_by_offset = 0, velocity_by_velocity = 1, velocity_by_force = 0;
  /// The same for a force of slope 1 N/s that is 0 in the middle of the step.
  double offset_by_growth = 0, velocity_by_growth = 0;
};

/// @param h_s above 0
OscillatorStep oscillator_step(const CouplingAxis& axis, double h_s);

class CouplingLaw {
 public:
  CouplingLaw() = default;
  CouplingLaw(CouplingScheme scheme, const CouplingAxis& axis) : scheme_(scheme), axis_(axis) {}

  /// Drops the history: clone and target move at these velocities.
  void restart(double clone_velocity, double target_velocity);

  /// Starts a step of h_s seconds.
  FreeStep begin(double offset, double target_velocity, double h_s);

  /// Ends the step with the clone's velocity after the contact solver.
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
  double last_h_s_ = 0;                        ///< 0: velocity_ is instantaneous
  double load_ = 0;                            ///< force on the clone over the last step
  Sampled now_;                                ///< for steps of sampled_h_s_; cached
  double sampled_h_s_ = 0;
  // The current step:
  FreeStep step_;
  double h_s_ = 0, next_target_velocity_ = 0;
};

/// Inputs of the contact solver for one step.
struct CoupledClone {
  Velocity velocity;  ///< of the clone without contacts
  double mass_kg = 0;
  Eigen::Vector3d inertia_kg_m2 =
      Eigen::Vector3d::Zero();  ///< about its axes; zero: impulses do not rotate it
};

/// The coupling on all axes of a clone: inputs of the contact solver before a step, and its results
/// after it.
class CloneCoupling {
 public:
  CloneCoupling() = default;

  /// @param locked the clone has the effector's orientation
  CloneCoupling(CouplingScheme scheme, const Scene& scene, bool locked);

  /// Drops the history: clone and target move at these velocities.
  void restart(const BodyState& clone, const Velocity& target_velocity);

  /// Starts a step in which the target moves from one pose to another.
  CoupledClone begin(const Pose& clone, const Pose& from, const Pose& to, double h_s);

  /// Ends the step with the clone after the contact solver.
  void end(const BodyState& clone);

 private:
  void begin_turn(const Pose& clone, const Pose& from, const Velocity& of_target, double h_s,
                  CoupledClone& free);

  bool locked_ = true;
  std::array<CouplingLaw, 3> translation_, rotation_;  // world axes, the clone's own axes
};

}  // namespace heft
