// How well masses are told apart at each reference, whatever the criterion: see
// PooledSensitivity.h.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "analysis/Dataset.h"
#include "analysis/Jnd.h"
#include "analysis/PooledSensitivity.h"

namespace heft {

struct ReferenceSensitivity {
  Compared compared;
  PooledSensitivity pooled;
  std::optional<StartEffect> start_effect;  ///< where staircases began high and low
};

/// Completed comparisons of a participant at one reference, catch trials too: left, none, right by
/// the mass on the right minus that on the left.
AnswersByLevel answers_by_side(std::span<const Attempt* const> attempts);

/// The comparisons that a fit takes, by what was compared and participant: completed, no practice.
std::map<std::pair<Compared, std::string>, std::vector<const Attempt*>> usable_comparisons(
    std::span<const SessionData> sessions);

/// By reference, lightest first, and condition; participants' sessions together.
std::vector<ReferenceSensitivity> sensitivities_of(std::span<const SessionData> sessions);

/// The interval of the second threshold divided by the first, both identifiable and of one study:
/// each bootstrap sample draws the same people at both.
Interval threshold_ratio_interval(const PooledSensitivity& first, const PooledSensitivity& second,
                                  double confidence = confidence_level);

}  // namespace heft
