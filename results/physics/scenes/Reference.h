// The truth that the study measures against: a closed form where there is one; elsewhere our own
// solver at a tiny step, with the difference to another engine at a tiny step as its uncertainty.
// Where rigid bodies have more than one answer, contacts give a little, in both. Without the other
// engine our own solver at half the rate takes its place; `method` says so.
#pragma once

#include <memory>
#include <string>

#include "physics/DecouplingSimulator.h"
#include "results/physics/scenes/SceneRun.h"

namespace heft {

struct Reference {
  SceneTrack track;            ///< at reference_rate_hz
  std::string method;          ///< "closed form", or which two runs agree
  double uncertainty_mm = 0;   ///< RMS difference of the clone's center between the two
  double cubes_differ_mm = 0;  ///< the same of the cubes
  /// How far the engines' cubes are apart where the same scene is rigid; 0 where that has one
  /// answer.
  double rigid_cubes_differ_mm = 0;
};

/// Makes the reference for a scene; a second or so of work.
/// @param quick a coarser step and no other engine
Reference reference_of(const BenchScene& scene, bool quick);

// The same law on another engine, Open Dynamics Engine 0.16: the independent half of a converged
// reference. Forces are explicit, as the paper writes them, so it needs steps of some 20 us.
// Contacts may give: ODE's own springs and dampers then, as stiff as the scene says and critically
// damped. Only where the library was there at build time.

/// Steps a second at which it is meant to run.
inline constexpr int ode_rate_hz = 48000;

/// @return nothing where Heft was built without ODE
std::unique_ptr<DecouplingSimulator> make_ode_simulator();

}  // namespace heft
