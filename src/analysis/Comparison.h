// What was chosen in comparisons, whatever the staircases made of it: how often the chosen cube was
// the lighter one, and how often a difference was seen where there was none.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "analysis/ComparisonTrials.h"
#include "analysis/Fold.h"
#include "inference/Proportion.h"

namespace heft {

/// Completed comparisons at one reference in one condition, or at one difference from it. All
/// participants together.
struct ComparisonChoices {
  Compared compared;
  std::optional<double> level_g;  ///< comparison - reference; none: all levels together
  int n_trials = 0;
  Rate difference;   ///< a cube was chosen, of all trials but catch trials
  Rate wrong_cube;   ///< the lighter one was, of the choices between cubes that differ
  Rate false_alarm;  ///< a cube was chosen, of catch trials
  Rate at_zero;      ///< a cube was chosen, of a staircase's own trials at difference 0
};

struct ComparisonSummary {
  std::vector<ComparisonChoices> by_reference;  ///< and condition
  std::vector<ComparisonChoices> by_level;      ///< by reference, then level; no catch trials
  Rate wrong_cube, false_alarm, at_zero;        ///< all references together
};

ComparisonSummary comparisons_of(const ComparisonTrials& trials);
inline ComparisonSummary comparisons_of(std::span<const SessionData> sessions) {
  return comparisons_of(folded<ComparisonTrials>(sessions));
}

}  // namespace heft
