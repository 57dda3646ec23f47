// Error and cost of every simulator at every rate in every scene, for the tables and the chart of
// error against CPU time.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "results/Study.h"
#include "results/physics/scenes/Reference.h"
#include "results/physics/scenes/SceneRun.h"

namespace heft {

/// Energy balance of a whole run, J, which needs no reference simulator. Ignores the clone's
/// rotation.
struct EnergyBalance {
  double hand_work_j = 0;  ///< on the spring and its damper; of a coupled clone, on the cubes
  double damped_j = 0;     ///< by the coupling
  double rubbed_j = 0;  ///< by friction on the table, with a quarter of the weight on each corner
  double stored_j = 0;  ///< gain of spring, kinetic and potential energy

  /// Dissipated by impacts and friction between boxes; negative values are errors.
  double left_j() const { return hand_work_j - damped_j - rubbed_j - stored_j; }
};

/// @param track with a state for every step, so that contact forces are constant between states
/// @return none for stacked cubes or an effector that leaves the view
std::optional<EnergyBalance> energy_balance(const SceneTrack& track, const BenchScene& scene);

struct Measurement {
  std::string simulator;
  int rate_hz = 0;
  BenchScene scene;
  RunOutcome outcome = RunOutcome::ran;
  std::string why;
  TrackError error;
  double cpu_us_per_s = 0;            ///< of one core, per simulated second
  std::optional<SolveCounts> counts;  ///< over the scene
  std::optional<EnergyBalance> energy;
};

struct Measurements {
  std::vector<Measurement> all;
  std::vector<std::pair<BenchScene, Reference>> references;
};

/// The simulators without aliases and without `auto`.
std::vector<SimulatorEntry> measured_simulators();

Measurements measure(const StudyOptions& options);

/// work_precision.csv, a row for each measurement; references.csv, a row for each scene.
void write_tables(const StudyOptions& options, const Measurements& measurements);

/// work_precision.svg, from the folder's work_precision.csv.
void draw_work_precision(const StudyOptions& options);

}  // namespace heft
