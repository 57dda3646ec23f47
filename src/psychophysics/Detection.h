// Sensitivity and criterion of somebody who says in each trial whether there was a difference:
// signal detection with equal variances (Macmillan & Creelman 2005).
#pragma once

#include <optional>

namespace heft {

/// Trials with a difference (signal) and without (noise), and in how many a difference was told.
struct DetectionCounts {
  int n_signal = 0, n_hits = 0;
  int n_noise = 0, n_false_alarms = 0;
};

/// Standard errors: Gourevitch & Galanter (1967), from the corrected rates.
struct Detection {
  double d_prime = 0, d_prime_se = 0;
  double criterion = 0, criterion_se = 0;  ///< positive: inclined to say "no difference"
};

/// With log-linear rates, (x + 1/2) / (n + 1), which are never 0 or 1 (Hautus 1995).
/// @return none where there is no trial of either kind
std::optional<Detection> detection(const DetectionCounts& counts);

}  // namespace heft
