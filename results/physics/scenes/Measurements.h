// Every simulator at every rate through every scene: how far off, at what cost. The tables and the
// chart of error against CPU time come from these.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "results/Study.h"
#include "results/physics/scenes/Reference.h"
#include "results/physics/scenes/SceneRun.h"

namespace heft {

// Where the hand's work went: a balance that needs no other simulator to compare with.

/// Of a whole run, joules. The clone's turning is left out.
struct EnergyBalance {
  double hand_work_j = 0;  ///< on the spring and its damper; of a coupled clone, on the cubes
  double damped_j = 0;     ///< by the coupling
  double rubbed_j = 0;     ///< by the table, a quarter of each cube's weight on each of its corners
  double stored_j = 0;     ///< more at the end than at the start: spring, motion, height

  /// What hits and rubbing between boxes took. Below zero: what came from nowhere.
  double left_j() const { return hand_work_j - damped_j - rubbed_j - stored_j; }
};

/// @param track with a state for every step, so that each has steady pushes
/// @return none where cubes stand on each other, or the effector goes out of view
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

/// Simulators that stand for themselves: without aliases and without those that pick another.
std::vector<SimulatorEntry> measured_simulators();

Measurements measure(const StudyOptions& options);

/// work_precision.csv, a row a measurement; references.csv, a row a scene.
void write_tables(const StudyOptions& options, const Measurements& measurements);

/// work_precision.svg
void draw_work_precision(const StudyOptions& options, std::span<const Measurement> measurements);

}  // namespace heft
