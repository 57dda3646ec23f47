// What each trial is made of: pure functions of protocol, seed, trial number and attempt. Streams
// are keyed so that a void attempt redraws its own arrangement and nothing else.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "experiment/Rows.h"
#include "protocol/Protocol.h"
#include "psychophysics/Interleaving.h"

namespace heft {

/// Which trial of the session is meant.
struct TrialKey {
  std::uint64_t seed = 0;
  int trial_number = 0;
  int attempt = 1;
};

/// Condition of each trial of a block: c1_trials of C1 at random places, no run longer than
/// max_run, every such sequence equally likely.
std::vector<Condition> draw_conditions(const SortingBlock& block, std::uint64_t seed);

/// @param n_wrong wrong answers so far; only `reshuffle` arranges anew after each
TrialPlan plan_introduction(const IntroductionBlock& block, const TrialKey& key, int n_wrong);

/// @param index the trial's place in its block, from 0
TrialPlan plan_sorting(const SortingBlock& block, const TrialKey& key, int index);

/// The comparison that comes next and the staircase it belongs to (none: a catch trial).
struct ComparisonPlan {
  TrialPlan plan;
  std::optional<std::size_t> staircase;
};

/// A comparison's answer: positive by the block's rule, and which was chosen.
Response response_to(const ComparisonBlock& block, const TrialRow& completed);

/// @param staircases in the order of the block's, at least one unfinished
/// @param previous staircase of the last completed trial that belonged to one
ComparisonPlan plan_comparison(const ComparisonBlock& block, const TrialKey& key,
                               const std::vector<Procedure>& staircases,
                               std::optional<std::size_t> previous);

}  // namespace heft
