// `heft bench physics`: cost, error and failures of the simulators.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "results/Study.h"
#include "results/physics/scenes/RandomScenes.h"
#include "results/physics/scenes/SceneRun.h"

namespace heft {

void run_physics_study(const StudyOptions& options);

/// hands.csv and hands.svg: quantiles of the errors in random scenes of simulated hands.
void study_hands(const StudyOptions& options);

/// A simulator that `auto` chooses from, at its rate, in a random scene that it models.
struct PromisedRun {
  std::string_view simulator;
  Setting setting = Setting::straight;
  int scene = 0;  ///< its number in the setting
  RunOutcome outcome = RunOutcome::ran;
  TrackError error{};
  double times_tolerance = 0;  ///< of its errors

  std::string_view hands() const;  ///< "even" or "uneven", see KnownError
};
/// @param n_each scenes of each setting, every second one with compliant contacts
std::vector<PromisedRun> promised_runs(std::uint64_t seed, int n_each);

/// promise.csv: the errors that `auto` promises, a quantile over random scenes.
void study_promise(const StudyOptions& options);

/// growth.csv and growth.svg: the cost of a step against the number of cubes.
void study_growth(const StudyOptions& options);

/// input.csv and input.svg: errors of the target's path from camera poses, compared with a
/// continuously known hand.
void study_input(const StudyOptions& options);

/// lag_vs_mass.csv and lag_vs_mass.svg: distance of the clone behind the effector against the
/// cube's mass, which is the cue to mass.
void study_lag(const StudyOptions& options);

/// The color of a simulator in the study's charts, for gnuplot: one family of hues for Heft's
/// solvers, one for its schemes on Bullet, one for stock Bullet.
std::string color_of(std::string_view simulator);

}  // namespace heft
