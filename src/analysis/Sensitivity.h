// How well masses are discriminated at each reference, whatever the criterion: of the study (see
// PooledSensitivity.h), and of each participant, whose few dozen trials seldom identify a
// threshold.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/ComparisonTrials.h"
#include "analysis/Dataset.h"
#include "analysis/Jnd.h"
#include "analysis/StudyEstimate.h"
#include "inference/PooledSensitivity.h"

namespace heft {

struct ReferenceSensitivity {
  Compared compared;
  PooledSensitivity pooled;
  bool as_published = false;  ///< compared at a reference and in the technique of the paper
};

/// By reference, lightest first, and condition; participants' sessions together.
std::vector<ReferenceSensitivity> sensitivities_of(const ComparisonTrials& trials);
inline std::vector<ReferenceSensitivity> sensitivities_of(std::span<const SessionData> sessions) {
  return sensitivities_of(folded<ComparisonTrials>(sessions));
}

/// Threshold, sensitivity and criterion of each, and the ratios of thresholds at neighboring
/// references.
void put_sensitivities(Estimates& all, std::span<const ReferenceSensitivity> rows);

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
