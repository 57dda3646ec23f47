// The comparison (paper, 4.2): a reference and a comparison, which is heavier, or no difference.
// Levels come from interleaved staircases; catch trials, whose difference is 0, from none.
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
  ComparisonRun(ComparisonRun&&) noexcept;
  ComparisonRun& operator=(ComparisonRun&&) noexcept;
  ~ComparisonRun();

  TrialPlan plan(const TrialKey& key) const;
  bool done() const;
  /// Tells the trial's staircase its answer; what that gives goes into the changes.
  void complete(Changes& changes);

  /// The staircase that runs alone where several were to be interleaved; none before that.
  std::optional<std::string> survivor() const;

 private:
  void respond(std::size_t staircase, Changes& changes);

  ComparisonBlock block_;
  std::vector<Procedure> staircases_;    // in the order of the block's
  std::optional<std::size_t> previous_;  // of the last completed trial that belonged to one
};

}  // namespace heft
