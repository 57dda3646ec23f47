#include "bench/physics/Measurements.h"

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
  Measurement one{std::string(simulator.name), rate_hz, scene, Fate::ran, "", {}, nothing};
  const SceneRun run = run_scene(simulator.make(), scene, rate_hz, rate_hz);
  one.fate = run.fate;
  one.why = run.why;
  if (run.fate == Fate::ran) one.error = error_of(run.track, reference, scene);
  if (run.fate != Fate::outside_model)
    one.cpu_us_per_s = cpu_us_per_s(simulator, scene, rate_hz, quick ? 0 : 0.01);
  return one;
}

// The worst of one scene class.
struct ClassError {
  int n_scenes = 0, n_outside = 0, n_blown_up = 0;
  double clone_rms_mm = 0, cubes_rms_mm = 0, turn_rms_deg = 0, lag_error_g = 0;

  void add(const Measurement& one) {
    ++n_scenes;
    n_outside += one.fate == Fate::outside_model;
    n_blown_up += one.fate == Fate::blew_up;
    if (one.fate != Fate::ran) return;
    clone_rms_mm = std::max(clone_rms_mm, one.error.clone_rms_mm);
    cubes_rms_mm = std::max(cubes_rms_mm, one.error.cubes_rms_mm);
    turn_rms_deg = std::max(turn_rms_deg, one.error.clone_turn_rms_deg);
    lag_error_g = std::max(lag_error_g, std::abs(one.error.lag_error_g));
  }
  bool any_ran() const { return n_scenes > n_outside + n_blown_up; }
};

// A rule that picks a simulator is for scenes with about the paper's springs.
bool has_the_papers_springs(const BenchScene& scene) {
  const Coupling papers, &coupling = scene.scene.coupling;
  return coupling.stiffness_n_per_m == papers.stiffness_n_per_m &&
         (scene.kind == SceneClass::free_air ||
          coupling.torsional_stiffness_nm_per_rad == papers.torsional_stiffness_nm_per_rad);
}

void write_errors(const StudyOptions& options, std::span<const Measurement> all) {
  std::map<std::tuple<std::string, int, SceneClass>, ClassError> worst;
  for (const Measurement& one : all)
    if (has_the_papers_springs(one.scene))
      worst[{one.simulator, one.rate_hz, one.scene.kind}].add(one);
  CsvFile csv(options, "errors.csv",
              "simulator,rate_hz,scene_class,n_scenes,n_outside_model,n_blew_up,"
              "worst_clone_rms_mm,worst_cubes_rms_mm,worst_clone_turn_rms_deg,worst_lag_error_g");
  for (const auto& [key, error] : worst) {
    const auto& [simulator, rate_hz, kind] = key;
    const auto known = [&](double value) { return error.any_ran() ? value : nothing; };
    csv.row(simulator, rate_hz, name_of(kind), error.n_scenes, error.n_outside, error.n_blown_up,
            known(error.clone_rms_mm), known(error.cubes_rms_mm), known(error.turn_rms_deg),
            known(error.lag_error_g));
  }
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
  CsvFile csv(options, "work_precision.csv",
              "simulator,rate_hz,scene,scene_class,unique_if_rigid,fate,clone_rms_mm,clone_max_mm,"
              "clone_turn_rms_deg,cubes_rms_mm,lag_error_g,cpu_us_per_simulated_s");
  for (const Measurement& one : measurements.all) {
    const auto known = [&](double value) { return one.fate == Fate::ran ? value : nothing; };
    csv.row(one.simulator, one.rate_hz, one.scene.name, name_of(one.scene.kind),
            one.scene.unique_if_rigid() ? "yes" : "no", name_of(one.fate),
            known(one.error.clone_rms_mm), known(one.error.clone_max_mm),
            known(one.error.clone_turn_rms_deg), known(one.error.cubes_rms_mm),
            known(one.error.lag_error_g), one.cpu_us_per_s);
  }
  write_errors(options, measurements.all);
  write_references(options, measurements);
}

}  // namespace heft
