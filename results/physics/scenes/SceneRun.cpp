#include "results/physics/scenes/SceneRun.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/Error.h"
#include "base/Pose.h"
#include "results/Study.h"

namespace heft {

namespace {
double time_of(const Trajectory& path, int n, int rate_hz) {
  return path.start_s() + n / static_cast<double>(rate_hz);
}

int n_steps(const BenchScene& scene, int rate_hz) {
  return static_cast<int>(std::floor(scene.duration_s() * rate_hz + 1e-6));
}

// Poses for every step; the last one while the effector is out of view.
std::vector<Pose> targets_of(const BenchScene& scene, int rate_hz) {
  const Trajectory path(scene.path);
  std::vector<Pose> targets;
  for (int n = 0; n <= n_steps(scene, rate_hz); ++n) {
    const auto pose = path.at(time_of(path, n, rate_hz));
    targets.push_back(pose ? *pose : targets.back());
  }
  return targets;
}

// Runs to the end or until unstable. @return CPU seconds per simulated second
double timed_run(DecouplingSimulator& simulator, const Scene& scene,
                 const std::vector<Pose>& targets, double h_s) {
  simulator.reset(scene, targets.front());
  std::size_t done = 0;
  const double started_s = thread_cpu_s();
  try {
    while (++done < targets.size()) simulator.step(targets[done], h_s);
  } catch (const Error&) {
  }
  return (thread_cpu_s() - started_s) / (static_cast<double>(done) * h_s);
}

double mean_of(const std::vector<double>& values) {
  double sum = 0;
  for (double value : values) sum += value;
  return values.empty() ? 0 : sum / static_cast<double>(values.size());
}
}  // namespace

SceneRun run_scene(std::unique_ptr<DecouplingSimulator> simulator, const BenchScene& scene,
                   int step_rate_hz, int keep_rate_hz, int poses_hz) {
  if (poses_hz == 0) poses_hz = step_rate_hz;
  SceneRun run;
  run.track.rate_hz = keep_rate_hz;
  const Trajectory path(scene.path);
  const int every = poses_hz / keep_rate_hz;
  try {
    Drive drive(std::move(simulator), scene.scene, step_rate_hz);
    for (int n = 0; n <= n_steps(scene, poses_hz); ++n) {
      const double t_s = time_of(path, n, poses_hz);
      const WorldState& state = drive.advance(sample_of(t_s, path.at(t_s)));
      if (n % every == 0) run.track.states.push_back(state);
      run.counts = drive.counts();
    }
  } catch (const OutsideModel& error) {
    run.outcome = RunOutcome::outside_model;
    run.why = error.what();
  } catch (const Error& error) {
    run.outcome = RunOutcome::blew_up;
    run.why = error.what();
  }
  return run;
}

TrackError error_of(const SceneTrack& track, const SceneTrack& reference, const BenchScene& scene) {
  const auto every = static_cast<std::size_t>(reference.rate_hz / track.rate_hz);
  const Trajectory path(scene.path);
  const Coupling& coupling = scene.scene.coupling;
  const double g_per_m =
      1e3 * coupling.stiffness_n_per_m / (scene.scene.friction * scene.scene.gravity_m_s2);
  TrackError error;
  std::vector<double> clone_mm2, turn_deg2, cube_mm2, lag_g;
  const std::size_t n = std::min(track.states.size(), (reference.states.size() - 1) / every + 1);
  for (std::size_t i = 0; i < n; ++i) {
    const WorldState& state = track.states[i];
    const WorldState& truth = reference.states[i * every];
    for (std::size_t c = 0; c < truth.cubes.size(); ++c)
      cube_mm2.push_back(
          1e6 * (state.cubes[c].pose.position_m - truth.cubes[c].pose.position_m).squaredNorm());
    const double t_s = time_of(path, static_cast<int>(i), track.rate_hz);
    const auto hand = path.at(t_s);
    if (!hand || !state.clone_present || !truth.clone_present) continue;
    const Pose &is = state.clone.pose, &should = truth.clone.pose;
    const double off_mm = 1e3 * (is.position_m - should.position_m).norm();
    clone_mm2.push_back(off_mm * off_mm);
    error.clone_max_mm = std::max(error.clone_max_mm, off_mm);
    const double turn_deg =
        rotation_vector(should.orientation.conjugate() * is.orientation).norm() * 180 / M_PI;
    turn_deg2.push_back(turn_deg * turn_deg);
    if (t_s > path.start_s() + 0.75 * scene.duration_s())
      lag_g.push_back(g_per_m * ((is.position_m - hand->position_m).norm() -
                                 (should.position_m - hand->position_m).norm()));
  }
  error.clone_rms_mm = std::sqrt(mean_of(clone_mm2));
  error.clone_turn_rms_deg = std::sqrt(mean_of(turn_deg2));
  error.cubes_rms_mm = std::sqrt(mean_of(cube_mm2));
  error.lag_error_g = mean_of(lag_g);
  return error;
}

double times_tolerance(const TrackError& error, const BenchScene& scene) {
  const Tolerance tolerance;
  const double lag_g = scene.scene.displacement ? 0 : std::abs(error.lag_error_g);
  return std::max({error.clone_rms_mm / (1e3 * tolerance.clone_rms_m), lag_g / tolerance.lag_g,
                   error.cubes_rms_mm / (1e3 * tolerance.cubes_rms_m),
                   error.clone_turn_rms_deg / (tolerance.turn_rms_rad * 180 / M_PI)});
}

double cpu_us_per_s(const SimulatorEntry& simulator, const BenchScene& scene, int rate_hz,
                    double at_least_s) {
  const std::vector<Pose> targets = targets_of(scene, rate_hz);
  const auto one = simulator.make();
  double best = std::numeric_limits<double>::infinity();
  const double started_s = thread_cpu_s();
  for (int i = 0; i < 3 || thread_cpu_s() - started_s < at_least_s; ++i)
    best = std::min(best, timed_run(*one, scene.scene, targets, 1.0 / rate_hz));
  return 1e6 * best;
}

}  // namespace heft
