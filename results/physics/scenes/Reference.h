// Reference solutions of the study: a closed form if there is one, otherwise Heft's solver at a
// tiny step, with the difference from another engine at a tiny step as the uncertainty. Scenes
// without a unique rigid solution have compliant contacts in both. Without the other engine, Heft's
// solver at half the rate replaces it, see `method`.
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
  /// Difference of the engines' cubes in the same scene with rigid contacts; 0 if that has a unique
  /// solution.
  double rigid_cubes_differ_mm = 0;
};

/// Computes the reference for a scene in about a second.
/// @param quick a coarser step and no other engine
Reference reference_of(const BenchScene& scene, bool quick);

// The same coupling on Open Dynamics Engine 0.16, the independent half of a converged reference.
// Forces are explicit, as in the paper, so steps of about 20 us are needed. Compliant contacts are
// ODE's springs and dampers with the scene's stiffness and critical damping. Only in builds with
// ODE.

/// Its rate, Hz.
inline constexpr int ode_rate_hz = 48000;

/// @return null in builds without ODE
std::unique_ptr<DecouplingSimulator> make_ode_simulator();

}  // namespace heft
