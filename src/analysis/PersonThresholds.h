// Each participant's own threshold at each reference, where their trials bear one: a few dozen
// seldom do, and who has none is counted, not left away. What a study says of people is
// PooledSensitivity.h.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/Sensitivity.h"

namespace heft {

/// A participant's finished staircases that began on one side.
struct StartedFigure {
  std::optional<double> start_g;  ///< mean first level
  std::optional<CensoredValue> jnd;
};

struct PersonThreshold {
  Compared compared;
  std::string participant;
  int n_trials = 0;
  std::optional<double> threshold_75_g;  ///< none: not identifiable
  std::optional<Interval> interval_g;    ///< see OwnSensitivity; of fewer people profile likelihood
  std::string why;                       ///< not identifiable; empty: it is
  std::optional<ParticipantJnd> jnd;     ///< the paper's, beside
  /// Of the staircases that began high and low in a session; of a single start all are from above.
  StartedFigure from_above, from_below;

  bool identifiable() const { return why.empty(); }
};

/// By reference and condition, then participant.
/// @param pooled  of the same sessions
std::vector<PersonThreshold> thresholds_of(const ComparisonTrials& trials,
                                           const StaircaseFold& staircases,
                                           std::span<const ReferenceSensitivity> pooled);

}  // namespace heft
