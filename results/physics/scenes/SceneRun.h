// Running a simulator through a bench scene: where everything went, what it cost, how far from the
// truth it was.
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

/// The rates that the study steps at. All divide the reference's, so that times meet.
inline constexpr std::array<int, 7> bench_rates_hz{15, 30, 60, 120, 240, 480, 960};
inline constexpr int reference_rate_hz = 960;
/// Those that stability is looked at: up to twice the reference's.
inline constexpr std::array<int, 8> stability_rates_hz{15, 30, 60, 120, 240, 480, 960, 1920};

/// States at path start + n / rate_hz.
struct SceneTrack {
  int rate_hz = 0;
  std::vector<WorldState> states;
};

enum class RunOutcome {
  ran,
  outside_model,  ///< the simulator cannot represent this scene and said so
  blew_up
};

template <>
struct EnumNames<RunOutcome> {
  static constexpr std::array<std::string_view, 3> names{"ran", "outside_model", "blew_up"};
};

struct SceneRun {
  RunOutcome outcome = RunOutcome::ran;
  std::string why;   ///< in the simulator's words, unless it ran
  SceneTrack track;  ///< until then
  std::optional<SolveCounts> counts;
};

/// Steps along the scene's path at step_rate_hz and keeps states at keep_rate_hz, a divisor of it.
/// @param poses_hz at which the path is looked at, if not at every step; keep_rate_hz divides it
SceneRun run_scene(std::unique_ptr<DecouplingSimulator> simulator, const BenchScene& scene,
                   int step_rate_hz, int keep_rate_hz, int poses_hz = 0);

struct TrackError {
  double clone_rms_mm = 0, clone_max_mm = 0;  ///< of its center
  double clone_turn_rms_deg = 0;
  double cubes_rms_mm = 0;  ///< of all cubes' centers
  /// How much heavier (or lighter) than it is the cube seems: the mean error of the clone's
  /// distance to the effector over the last quarter of the path, times k / (mu g).
  double lag_error_g = 0;
};

/// @param track at a rate that divides the reference's
TrackError error_of(const SceneTrack& track, const SceneTrack& reference, const BenchScene& scene);

/// CPU time of this thread per simulated second, the best of several repeats: steps alone, without
/// reading states. Up to the blow-up where there is one.
double cpu_us_per_s(const SimulatorEntry& simulator, const BenchScene& scene, int rate_hz,
                    double at_least_s);

}  // namespace heft
