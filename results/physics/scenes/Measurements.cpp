#include "results/physics/scenes/Measurements.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace heft {

namespace {
constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

std::vector<BenchScene> scenes_to_measure(bool quick) {
  if (!quick) return bench_scenes();
  return {bench_scene("free_return"), bench_scene("push_200g"), bench_scene("cube_into_cube")};
}

std::vector<int> rates_to_measure(bool quick) {
  if (quick) return {60, 240};
  return {bench_rates_hz.begin(), bench_rates_hz.end()};
}

Measurement measure_one(const SimulatorEntry& simulator, const BenchScene& scene, int rate_hz,
                        const SceneTrack& reference, bool quick) {
  Measurement one;
  one.simulator = simulator.name;
  one.rate_hz = rate_hz;
  one.scene = scene;
  one.cpu_us_per_s = nothing;
  const SceneRun run = run_scene(simulator.make(), scene, rate_hz, rate_hz);
  one.outcome = run.outcome;
  one.why = run.why;
  one.counts = run.counts;
  if (run.outcome == RunOutcome::ran) {
    one.error = error_of(run.track, reference, scene);
    one.energy = energy_balance(run.track, scene);
  }
  if (run.outcome != RunOutcome::outside_model)
    one.cpu_us_per_s = cpu_us_per_s(simulator, scene, rate_hz, quick ? 0 : 0.01);
  return one;
}

void write_references(const StudyOptions& options, const Measurements& measurements) {
  CsvFile csv(options, "references.csv",
              "scene,scene_class,method,clone_differs_rms_mm,cubes_differ_rms_mm,unique_if_rigid,"
              "cubes_differ_if_rigid_rms_mm");
  for (const auto& [scene, reference] : measurements.references)
    csv.row(scene.name, name_of(scene.kind), reference.method, reference.uncertainty_mm,
            reference.cubes_differ_mm, scene.unique_if_rigid() ? "yes" : "no",
            scene.unique_if_rigid() ? reference.cubes_differ_mm : reference.rigid_cubes_differ_mm);
}
}  // namespace

std::vector<SimulatorEntry> measured_simulators() {
  std::vector<SimulatorEntry> some;
  for (const SimulatorEntry& entry : simulators())
    if (entry.name != "bullet" && entry.name != "auto") some.push_back(entry);
  return some;
}

Measurements measure(const StudyOptions& options) {
  const std::vector<BenchScene> scenes = scenes_to_measure(options.quick);
  Measurements measurements;
  StudyProgress progress(static_cast<int>(scenes.size()));
  for (const BenchScene& scene : scenes) {
    progress.next(scene.name);
    const Reference reference = reference_of(scene, options.quick);
    for (int rate_hz : rates_to_measure(options.quick))
      for (const SimulatorEntry& simulator : measured_simulators())
        measurements.all.push_back(
            measure_one(simulator, scene, rate_hz, reference.track, options.quick));
    measurements.references.emplace_back(scene, reference);
    measurements.references.back().second.track.states.clear();
  }
  return measurements;
}

void write_tables(const StudyOptions& options, const Measurements& measurements) {
  CsvFile csv(
      options, "work_precision.csv",
      "simulator,rate_hz,scene,scene_class,unique_if_rigid,outcome,clone_rms_mm,clone_max_mm,"
      "clone_turn_rms_deg,cubes_rms_mm,lag_error_g,cpu_us_per_simulated_s,not_converged_per_s,"
      "hits_per_s,hand_work_mj,energy_left_mj");
  for (const Measurement& one : measurements.all) {
    const auto known = [&](double value) {
      return one.outcome == RunOutcome::ran ? value : nothing;
    };
    const auto per_s = [&](long SolveCounts::*n) {
      return one.counts ? known(static_cast<double>(*one.counts.*n) / one.scene.duration_s())
                        : nothing;
    };
    csv.row(one.simulator, one.rate_hz, one.scene.name, name_of(one.scene.kind),
            one.scene.unique_if_rigid() ? "yes" : "no", name_of(one.outcome),
            known(one.error.clone_rms_mm), known(one.error.clone_max_mm),
            known(one.error.clone_turn_rms_deg), known(one.error.cubes_rms_mm),
            known(one.error.lag_error_g), one.cpu_us_per_s, per_s(&SolveCounts::not_converged),
            per_s(&SolveCounts::hits), one.energy ? 1e3 * one.energy->hand_work_j : nothing,
            one.energy ? 1e3 * one.energy->left_j() : nothing);
  }
  write_references(options, measurements);
}

}  // namespace heft
