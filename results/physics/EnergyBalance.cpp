#include <cmath>

#include "experiment/Trajectory.h"
#include "physics/scene/Scene.h"
#include "results/physics/scenes/Measurements.h"

namespace heft {

namespace {
using Eigen::Vector3d;

constexpr double on_table_m = 1e-4;

bool all_on_table(const Scene& scene) {
  for (const Cube& cube : scene.cubes)
    if (cube.position_m.z() > cube.size_m.z() / 2 + on_table_m) return false;
  return true;
}

// Mean of v^2 over a step for a parabolic velocity with these ends and this mean.
double mean_square(const Vector3d& start, const Vector3d& end, const Vector3d& mean) {
  return mean.squaredNorm() + ((end - start) / 2).squaredNorm() / 3 +
         ((start + end) / 2 - mean).squaredNorm() / 5;
}

double stored_j(const WorldState& state, const Pose& hand, const Scene& scene) {
  const Coupling& coupling = scene.coupling;
  double sum_j = 0;
  if (coupling.decoupled) {
    const double stretch_2 = (state.clone.pose.position_m - hand.position_m).squaredNorm();
    sum_j += coupling.stiffness_n_per_m / 2 * stretch_2 +
             coupling.clone_mass_kg / 2 * state.clone.velocity.linear_m_s.squaredNorm();
  }
  for (std::size_t i = 0; i < scene.cubes.size(); ++i) {
    const auto& [pose, velocity] = state.cubes[i];
    const Cube& cube = scene.cubes[i];
    const Vector3d spin_rad_s = pose.orientation.conjugate() * velocity.angular_rad_s;
    sum_j += cube.mass_kg / 2 * velocity.linear_m_s.squaredNorm() +
             box_inertia_kg_m2(cube.mass_kg, cube.size_m).dot(spin_rad_s.cwiseAbs2()) / 2 +
             cube.mass_kg * scene.gravity_m_s2 * pose.position_m.z();
  }
  return sum_j;
}

// Mean sliding distance of a cube's four lower corners.
double way_m(const Pose& from, const Pose& to, const Vector3d& size_m) {
  double sum_m = 0;
  for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
    const Vector3d corner_m = Vector3d(x, y, -1).cwiseProduct(size_m / 2);
    sum_m += (to * corner_m - from * corner_m).head<2>().norm();
  }
  return sum_m / 4;
}

// The coupling force, from the clone's momentum and the contact forces of the cubes.
Vector3d impulse_on_clone_n_s(const WorldState& from, const WorldState& to, const Scene& scene,
                              double h_s) {
  Vector3d sum_n_s = Vector3d::Zero();
  if (scene.coupling.decoupled)
    sum_n_s = scene.coupling.clone_mass_kg *
              (to.clone.velocity.linear_m_s - from.clone.velocity.linear_m_s);
  for (const CubeContact& contact : to.contacts) sum_n_s += h_s * contact.force_n;
  return sum_n_s;
}
}  // namespace

std::optional<EnergyBalance> energy_balance(const SceneTrack& track, const BenchScene& bench) {
  const Scene& scene = bench.scene;
  const Coupling& coupling = scene.coupling;
  const Trajectory path(bench.path);
  if (!all_on_table(scene) || track.states.empty()) return std::nullopt;
  const double h_s = 1.0 / track.rate_hz;
  const double damping = coupling.decoupled
                             ? 2 * coupling.damping_ratio *
                                   std::sqrt(coupling.stiffness_n_per_m * coupling.clone_mass_kg)
                             : 0;
  EnergyBalance balance;
  std::optional<Pose> hand = path.at(path.start_s());
  const double at_start_j = hand ? stored_j(track.states.front(), *hand, scene) : 0;
  for (std::size_t i = 1; i < track.states.size(); ++i) {
    const WorldState &from = track.states[i - 1], &to = track.states[i];
    const auto next = path.at(path.start_s() + static_cast<double>(i) * h_s);
    if (!hand || !next || !from.clone_present || !to.clone_present) return std::nullopt;
    const Vector3d clone_m_s = (to.clone.pose.position_m - from.clone.pose.position_m) / h_s;
    const Vector3d hand_m_s =
        coupling.decoupled ? Vector3d((next->position_m - hand->position_m) / h_s) : clone_m_s;
    balance.hand_work_j += hand_m_s.dot(impulse_on_clone_n_s(from, to, scene, h_s));
    balance.damped_j += damping * h_s *
                        mean_square(from.clone.velocity.linear_m_s - hand_m_s,
                                    to.clone.velocity.linear_m_s - hand_m_s, clone_m_s - hand_m_s);
    for (std::size_t c = 0; c < scene.cubes.size(); ++c)
      balance.rubbed_j += scene.table_friction(c) * scene.gravity_m_s2 * scene.cubes[c].mass_kg *
                          way_m(from.cubes[c].pose, to.cubes[c].pose, scene.cubes[c].size_m);
    hand = next;
  }
  if (!hand) return std::nullopt;
  balance.stored_j = stored_j(track.states.back(), *hand, scene) - at_start_j;
  return balance;
}

}  // namespace heft
