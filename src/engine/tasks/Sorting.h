// The sorting task (paper, 4.1): two to six cubes, each given its label, then validated.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/TrialKey.h"
#include "experiment/Block.h"
#include "experiment/Rows.h"

namespace heft {

class SortingRun {
 public:
  SortingRun(const SortingBlock& block, std::uint64_t seed);

  TrialPlan plan(const TrialKey& key) const;
  bool done() const { return n_completed_ >= block_.n_trials(); }
  void complete(Changes&) { ++n_completed_; }

 private:
  SortingBlock block_;
  std::vector<std::string> techniques_;  // of each trial
  int n_completed_ = 0;
};

/// Technique of each trial of a block: each as often as the block says, at random places, no run
/// longer than max_run, every such sequence equally likely.
std::vector<std::string> draw_techniques(const SortingBlock& block, std::uint64_t seed);

}  // namespace heft
