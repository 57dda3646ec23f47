#include "results/physics/Stability.h"

#include <algorithm>
#include <cmath>

#include "base/math/Geometry.h"
#include "results/physics/scenes/RandomScenes.h"

namespace heft {

namespace {
constexpr double travel_m = 0.1, still_s = 0.75;  // after 0.25 s to come to rest

// Overlap by more than 0.1 mm, anywhere.
bool penetrates(const WorldState& state, const Scene& scene) {
  const Eigen::Vector3d less_m = Eigen::Vector3d::Constant(1e-4);
  for (std::size_t i = 0; i < state.cubes.size(); ++i) {
    const Eigen::Vector3d& size_m = scene.cubes[i].size_m;
    const Pose& at = state.cubes[i].pose;
    const double reach_m = (at.orientation.toRotationMatrix().row(2).cwiseAbs() * size_m)(0) / 2;
    if (at.position_m.z() < reach_m - 1e-4 ||
        boxes_overlap(state.clone.pose, scene.effector_size_m - less_m, at, size_m - less_m))
      return true;
  }
  return false;
}

// At the last step within the stroke.
bool has_wrong_lag(const SceneTrack& track, const SceneTrack& reference, const BenchScene& scene) {
  const double stroke_s = scene.duration_s() - 1;
  const auto i = static_cast<std::size_t>(stroke_s * track.rate_hz + 1e-6);
  const auto every = static_cast<std::size_t>(reference.rate_hz / track.rate_hz);
  const double t_s = static_cast<double>(i) / track.rate_hz;
  const Eigen::Vector3d hand_m = Trajectory(scene.path).at(t_s)->position_m;
  const Eigen::Vector3d& clone_m = track.states[i].clone.pose.position_m;
  const Eigen::Vector3d& expected_m = reference.states[i * every].clone.pose.position_m;
  return (clone_m - expected_m).norm() > std::max(0.02 * (hand_m - expected_m).norm(), 0.1e-3);
}

// Movement over the last states: range of the clone, displacement of the cube.
struct Rest {
  double clone_back_m = 0, cube_m = 0;
};

Rest rest_of(const std::vector<WorldState>& states, std::size_t from) {
  Rest rest;
  double length_m = 0;
  for (std::size_t i = from + 1; i < states.size(); ++i)
    length_m += (states[i].clone.pose.position_m - states[i - 1].clone.pose.position_m).norm();
  const WorldState &first = states[from], &last = states.back();
  rest.clone_back_m = length_m - (last.clone.pose.position_m - first.clone.pose.position_m).norm();
  for (std::size_t i = 0; i < last.cubes.size(); ++i)
    rest.cube_m = std::max(rest.cube_m,
                           (last.cubes[i].pose.position_m - first.cubes[i].pose.position_m).norm());
  return rest;
}
}  // namespace

BenchScene stability_scene(Varied varied, double value) {
  StraightPath path;
  path.speed_m_s = 0.1;
  path.length_m = travel_m + 0.002;
  BenchScene scene;
  scene.name = "stability";
  Cube cube;
  cube.mass_kg = 0.1;
  Coupling& coupling = scene.scene.coupling;
  if (varied == Varied::stiffness) {
    coupling.stiffness_n_per_m = value;
    cube.mass_kg *= std::sqrt(value / 50);  // keeps the lag visible at both ends
  } else if (varied == Varied::torsional_stiffness) {
    coupling.torsional_stiffness_nm_per_rad = value;
    path.side_m = 0.008;
  } else if (varied == Varied::damping) {
    coupling.damping_ratio = value;
    coupling.stiffness_n_per_m = 1e5;
    cube.mass_kg *= std::sqrt(1e5 / 50);
  } else if (varied == Varied::cube_mass) {
    cube.mass_kg = value;
  }
  scene.scene.cubes = {cube};
  if (varied == Varied::second_cube_mass) {
    path.broadside = true;
    scene.scene.cubes[0].position_m.y() = -0.021;
    cube.position_m = {0.005, 0.021, cube.position_m.z()};
    cube.mass_kg = value;
    scene.scene.cubes.push_back(cube);
  }
  scene.path = path.rows();
  return scene;
}

Verdict judge(const SimulatorEntry& simulator, const BenchScene& scene, const SceneTrack& reference,
              int rate_hz) {
  const int keep_hz = std::min(rate_hz, reference_rate_hz);
  const SceneRun run = run_scene(simulator.make(), scene, rate_hz, keep_hz);
  if (run.outcome == RunOutcome::outside_model) return Verdict::outside_model;
  if (run.outcome == RunOutcome::blew_up) return Verdict::blows_up;
  const std::vector<WorldState>& states = run.track.states;
  const auto far = [&](const WorldState& s) { return s.clone.pose.position_m.norm() > 1; };
  if (std::ranges::any_of(states, far)) return Verdict::blows_up;
  if (has_wrong_lag(run.track, reference, scene)) return Verdict::wrong_lag;
  const auto inside = [&](const WorldState& s) { return penetrates(s, scene.scene); };
  if (std::ranges::any_of(states, inside)) return Verdict::penetrates;
  const auto from = static_cast<std::size_t>(std::lround((scene.duration_s() - still_s) * keep_hz));
  const Rest rest = rest_of(states, from);
  if (rest.clone_back_m > 20e-6) return Verdict::rings;
  return rest.cube_m > 1e-6 ? Verdict::creeps : Verdict::stable;
}

std::vector<double> values_of(Varied varied, bool quick) {
  if (varied == Varied::stiffness) {
    if (quick) return {50, 5e4};
    return {0.5, 5, 50, 500, 5e3, 5e4, 5e5};
  }
  if (varied == Varied::torsional_stiffness) {
    if (quick) return {150};
    return {1.5e-4, 1.5e-3, 1.5e-2, 0.15, 1.5, 15, 150, 1.5e3, 1.5e4, 1.5e5};
  }
  if (varied == Varied::damping) {
    if (quick) return {1};
    return {0, 0.01, 0.03, 0.06, 0.12, 0.25, 0.5, 1, 2, 4};
  }
  if (quick) return {0.15};
  return {0.0015, 0.015, 0.05, 0.15, 0.5, 1.5, 15};
}

void study_stability(const StudyOptions& options) {
  CsvFile csv(options, "stability.csv", "simulator,varied,value,rate_hz,verdict");
  std::vector<StabilityCell> cells;
  StudyProgress progress(static_cast<int>(all_varied.size()));
  for (Varied varied : all_varied) {
    progress.next(fmt::format("stability: {}", name_of(varied)));
    for (double value : values_of(varied, options.quick)) {
      const BenchScene scene = stability_scene(varied, value);
      const SceneTrack reference =
          run_scene(make_simulator("boxes"), scene, 16 * reference_rate_hz, reference_rate_hz)
              .track;
      for (const SimulatorEntry& simulator : measured_simulators()) {
        for (int rate_hz : stability_rates_hz) {
          if (options.quick && rate_hz != 60 && rate_hz != 240) continue;
          const Verdict verdict = judge(simulator, scene, reference, rate_hz);
          cells.push_back({std::string(simulator.name), varied, value, rate_hz, verdict});
          csv.row(simulator.name, name_of(varied), value, rate_hz, name_of(verdict));
        }
      }
    }
  }
  draw_stability(options, cells);
}

}  // namespace heft
