// The introduction: two cubes, one trial that ends when the heavier one is chosen (paper, 5.1).
#pragma once

#include <optional>

#include "engine/TrialKey.h"
#include "experiment/Block.h"
#include "experiment/Rows.h"

namespace heft {

class IntroductionRun {
 public:
  explicit IntroductionRun(const IntroductionBlock& block) : block_(block) {}

  TrialPlan plan(const TrialKey& key) const { return arranged(key, 0); }
  bool done() const { return done_; }
  void complete(Changes&) { done_ = true; }

  /// The cubes after so many wrong answers, where the block asks for newly shuffled ones.
  std::optional<TrialPlan> rearranged(const TrialKey& key, int n_wrong) const;

 private:
  TrialPlan arranged(const TrialKey& key, int n_shuffles) const;

  IntroductionBlock block_;
  bool done_ = false;
};

}  // namespace heft
