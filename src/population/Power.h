// What a study of a protocol can be expected to find: many studies of simulated participants, each
// analyzed as a study of people is, at several numbers of participants.
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "analysis/dataset/Summary.h"
#include "session/Session.h"

namespace heft {

struct PowerRequest {
  ResolvedConfig config;          ///< protocol, model and seed; study i draws its own seed from it
  std::vector<int> participants;  ///< sizes of a study, each at least 1
  int studies = 100;              ///< at least 1
  int jobs = 1;                   ///< threads; the result does not depend on them
  std::string folder;             ///< for the logs of the studies, which are removed after use
};

/// Verdicts on one hypothesis in the studies of one size.
struct HypothesisPower {
  std::string name, statement;
  bool declared = false;                         ///< by the protocol
  Tally supported, not_supported, inconclusive;  ///< of all studies
  bool is_tested = false;                        ///< in some study; otherwise inconclusive in all
  /// Clopper and Pearson's interval of the share that supported it, as fractions.
  Interval interval;
};

/// How precisely the studies of one size estimated one figure.
struct EstimatePrecision {
  StudyEstimate place;      ///< measure, task, condition and reference; without figures
  Tally printed;            ///< studies that gave a value with an interval, of all
  double median_value = 0;  ///< of these studies
  double median_low = 0, median_high = 0;
  std::optional<double> sd;  ///< of the value over studies
};

/// Results of all studies of one size: the first `participants` of each simulated study.
struct PowerAtSize {
  int participants = 0;
  std::vector<HypothesisPower> hypotheses;   ///< those that apply to the protocol
  std::vector<EstimatePrecision> estimates;  ///< over participants, in the order of the report
};

struct Power {
  int n_studies = 0;
  std::vector<PowerAtSize> sizes;  ///< from small to large
};

/// @param progress called with the fraction done, 0...1, from the calling thread
/// @param stop set to end early
/// @return none: stopped
/// @throws Error if a session fails or the folder cannot be written
std::optional<Power> power_of(const PowerRequest& request,
                              const std::function<void(double)>& progress,
                              const std::atomic<bool>& stop);

}  // namespace heft
