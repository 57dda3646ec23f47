// Which spring, or which other technique, shows a range of masses best: thresholds of simulated
// people at masses over the range.
//
// The people are all alike (the median of the model), so that all their answers in a forced choice
// make one psychometric function. Its 75 % threshold over the mass says how well the technique
// shows that mass; the best technique has the smallest of the largest of these ratios.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apparatus/configuration/ResolvedConfig.h"

namespace heft {

struct TuningRequest {
  Protocol protocol;       ///< its layout, physics and display; its blocks are not used
  SessionOptions session;  ///< with the model
  std::vector<Technique> techniques;
  std::vector<double> masses_g;
  int repeats = 100;  ///< of each difference
  int jobs = 1;       ///< threads; the result does not depend on them
  std::uint64_t seed = 1;
};

struct ThresholdAtMass {
  double mass_g = 0;
  std::optional<double> threshold_g, low_g, high_g;  ///< none: not identifiable
  std::string why;                                   ///< why it is not identifiable

  double ratio() const { return *threshold_g / mass_g; }
};

struct TunedTechnique {
  Technique technique;
  std::vector<ThresholdAtMass> masses;  ///< in the order of the request

  /// The largest ratio of threshold and mass; none: a mass has no threshold.
  std::optional<double> worst() const;
};

/// Springs of n stiffnesses, evenly spaced in logarithms. @param others the other parameters
std::vector<Technique> springs_between(double low_n_per_m, double high_n_per_m, int n,
                                       const Coupling& others);

/// n masses, evenly spaced in logarithms, with both ends.
std::vector<double> masses_between(double low_g, double high_g, int n);

/// Simulates the threshold of each technique at each mass.
/// @param progress called with the fraction done, 0...1, from the calling thread
/// @return none: stopped
std::optional<std::vector<TunedTechnique>> thresholds_of(
    const TuningRequest& request, const std::function<void(double)>& progress,
    const std::atomic<bool>& stop);

/// The technique with the smallest worst(); null: none has a threshold at every mass.
const TunedTechnique* best_of(const std::vector<TunedTechnique>& all);

}  // namespace heft
