// How well masses are discriminated at each reference, whatever the criterion: see
// PooledSensitivity.h.
#pragma once

#include <span>
#include <vector>

#include "analysis/dataset/ComparisonTrials.h"
#include "analysis/dataset/Dataset.h"
#include "analysis/dataset/StudyEstimate.h"
#include "inference/PooledSensitivity.h"

namespace heft {

struct ReferenceSensitivity {
  Compared compared;
  PooledSensitivity pooled;
  bool as_published = false;  ///< compared at a reference and in the technique of the paper
};

/// By reference, lightest first, and condition; participants' sessions together.
std::vector<ReferenceSensitivity> sensitivities_of(const ComparisonTrials& trials);

/// Threshold, sensitivity and criterion of each, and the ratios of thresholds at neighboring
/// references.
void put_sensitivities(Estimates& all, std::span<const ReferenceSensitivity> rows);

}  // namespace heft
