// Runs of a simulator through a scene: states, cost, and error against the reference.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/Names.h"
#include "physics/DecouplingSimulator.h"
#include "physics/Drive.h"
#include "results/physics/scenes/Scenes.h"

namespace heft {

/// The study's rates. All divide the reference's rate.
inline constexpr std::array<int, 7> bench_rates_hz{15, 30, 60, 120, 240, 480, 960};
inline constexpr int reference_rate_hz = 960;
/// Rates of the stability map, up to twice the reference's.
inline constexpr std::array<int, 8> stability_rates_hz{15, 30, 60, 120, 240, 480, 960, 1920};

/// States at path start + n / rate_hz.
struct SceneTrack {
  int rate_hz = 0;
  std::vector<WorldState> states;
};

enum class RunOutcome {
  ran,
  outside_model,  ///< the simulator threw OutsideModel
  blew_up
};

template <>
struct EnumNames<RunOutcome> {
  static constexpr std::array<std::string_view, 3> names{"ran", "outside_model", "blew_up"};
};

struct SceneRun {
  RunOutcome outcome = RunOutcome::ran;
  std::string why;   ///< the simulator's message, if it failed
  SceneTrack track;  ///< until then
  std::optional<SolveCounts> counts;
};

/// Steps along the scene's path at step_rate_hz and keeps states at keep_rate_hz, a divisor of it.
/// @param poses_hz rate at which the path is sampled, if not at every step; keep_rate_hz divides it
SceneRun run_scene(std::unique_ptr<DecouplingSimulator> simulator, const BenchScene& scene,
                   int step_rate_hz, int keep_rate_hz, int poses_hz = 0);

struct TrackError {
  double clone_rms_mm = 0, clone_max_mm = 0;  ///< of its center
  double clone_turn_rms_deg = 0;
  double cubes_rms_mm = 0;  ///< of all cubes' centers
  /// Error of the lag as a mass: the mean error of the clone's distance to the effector over the
  /// last quarter of the path, times k / (mu g).
  double lag_error_g = 0;
};

/// @param track at a rate that divides the reference's
TrackError error_of(const SceneTrack& track, const SceneTrack& reference, const BenchScene& scene);
/// The largest of the errors as a multiple of the default tolerance; without that of the lag where
/// the scene's technique has none.
double times_tolerance(const TrackError& error, const BenchScene& scene);

/// CPU time of this thread per simulated second, the best of several repeats: steps alone, without
/// reading states. Unstable runs are measured until they fail.
double cpu_us_per_s(const SimulatorEntry& simulator, const BenchScene& scene, int rate_hz,
                    double at_least_s);

}  // namespace heft
