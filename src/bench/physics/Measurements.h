// Every simulator at every rate through every scene: how far off, at what cost. The tables and the
// chart of error against CPU time come from these.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/StudyFiles.h"
#include "bench/physics/EnergyBalance.h"
#include "bench/physics/Reference.h"

namespace heft {

struct Measurement {
  std::string simulator;
  int rate_hz = 0;
  BenchScene scene;
  Fate fate = Fate::ran;
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
