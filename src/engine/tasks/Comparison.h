// The comparison (paper, 4.2): a reference and a comparison, which is heavier, or no difference.
// Levels come from interleaved staircases; catch trials, whose difference is 0, from none.
// Catch trials in a fixed number are drawn in shuffled blocks, so that a person has as many of each
// reference as planned, spread over the session, whatever the staircases do.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/TrialKey.h"
#include "experiment/Block.h"
#include "experiment/Rows.h"
#include "psychophysics/Interleaving.h"

namespace heft {

class ComparisonRun {
 public:
  explicit ComparisonRun(const ComparisonBlock& block);

  TrialPlan plan(const TrialKey& key) const;
  bool done() const;
  /// Tells the trial's staircase its answer; what that gives goes into the changes.
  void complete(Changes& changes);

  /// The staircase that runs alone where several were to be interleaved; none before that.
  std::optional<std::string> survivor() const;

 private:
  std::optional<double> catch_reference_g(std::uint64_t seed) const;
  std::size_t staircase_of(double reference_g, RandomStream& stream) const;
  int reference_slot(const TrialKey& key, const TrialPlan& plan, int n_before) const;
  void respond(std::size_t staircase, Changes& changes);

  ComparisonBlock block_;
  std::vector<Procedure> staircases_;    // in the order of the block's
  std::optional<std::size_t> previous_;  // of the last completed trial that belonged to one
  int n_completed_ = 0, n_caught_ = 0;   // trials, and catch trials among them
};

}  // namespace heft
