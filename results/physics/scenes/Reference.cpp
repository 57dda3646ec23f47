#include "results/physics/scenes/Reference.h"

#include <fmt/format.h>

#include "base/Error.h"
#include "base/Pose.h"
#include "physics/scene/Oracles.h"
#include "physics/scene/Scene.h"

namespace heft {

namespace {
constexpr const char* our_solver = "boxes";
constexpr int fine_rate_hz = 16 * reference_rate_hz, coarse_rate_hz = 4 * reference_rate_hz;

// A clone released from an offset along one direction and about one axis, the effector still.
SceneTrack free_return(const BenchScene& scene) {
  const Coupling& coupling = scene.scene.coupling;
  const Pose& offset = scene.scene.clone_offset;
  const Eigen::Vector3d turn_rad = rotation_vector(offset.orientation);
  Eigen::Index axis = 0;
  turn_rad.cwiseAbs().maxCoeff(&axis);
  const double inertia_kg_m2 =
      box_inertia_kg_m2(coupling.clone_mass_kg, scene.scene.effector_size_m)[axis];
  const FreeReturn shift(coupling.stiffness_n_per_m, coupling.clone_mass_kg,
                         coupling.damping_ratio);
  const FreeReturn turn(coupling.torsional_stiffness_nm_per_rad, inertia_kg_m2,
                        coupling.damping_ratio);
  SceneTrack track{reference_rate_hz, {}};
  const Pose hand = *scene.path.front().pose;
  for (int n = 0; n <= static_cast<int>(scene.duration_s() * reference_rate_hz); ++n) {
    const double t_s = n / static_cast<double>(reference_rate_hz);
    WorldState state;
    state.clone.pose = {hand.position_m + shift(t_s) * offset.position_m,
                        rotation_from_vector(turn(t_s) * turn_rad)};
    track.states.push_back(state);
  }
  return track;
}

SceneTrack converged(std::unique_ptr<DecouplingSimulator> simulator, const BenchScene& scene,
                     int rate_hz) {
  SceneRun run = run_scene(std::move(simulator), scene, rate_hz, reference_rate_hz);
  if (run.outcome != RunOutcome::ran)
    throw Error(
        fmt::format("no reference for the scene {} at {} Hz: {}", scene.name, rate_hz, run.why));
  return std::move(run.track);
}

// Two runs, and the difference of the second from the first.
struct Pair {
  SceneTrack first;
  TrackError between;
  std::string method;
};

// Without another engine, the second run is Heft's solver at half the rate.
Pair ours_and_other(const BenchScene& scene, int rate_hz, bool other_engine) {
  auto other = other_engine ? make_ode_simulator() : nullptr;
  const int other_hz = other ? ode_rate_hz : rate_hz / 2;
  Pair pair;
  pair.method = fmt::format("{} at {} Hz against {} at {} Hz", our_solver, rate_hz,
                            other ? "ODE" : our_solver, other_hz);
  if (!other) other = make_simulator(our_solver);
  pair.first = converged(make_simulator(our_solver), scene, rate_hz);
  pair.between = error_of(converged(std::move(other), scene, other_hz), pair.first, scene);
  return pair;
}
}  // namespace

Reference reference_of(const BenchScene& scene, bool quick) {
  if (scene.kind == SceneClass::free_air) return {free_return(scene), "closed form", 0, 0, 0};
  const int rate_hz = quick ? coarse_rate_hz : fine_rate_hz;
  Pair pair = ours_and_other(scene, rate_hz, !quick);
  Reference reference{std::move(pair.first), pair.method, pair.between.clone_rms_mm,
                      pair.between.cubes_rms_mm, 0};
  if (!scene.unique_if_rigid() && !quick) {
    BenchScene rigid = scene;
    rigid.scene.contact_compliance_m_per_n = 0;
    reference.rigid_cubes_differ_mm = ours_and_other(rigid, rate_hz, true).between.cubes_rms_mm;
  }
  return reference;
}

}  // namespace heft
