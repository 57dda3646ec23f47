// Whether answers depend on the level, or random answers explain them as well: the likelihood ratio
// of a logistic function of each person's answers against a constant share of them.
//
// In a staircase the levels depend on earlier answers, so that the chi-square distribution does not
// hold: an up-down staircase goes down after every "yes", and its highest levels were
// answered by "yes". More than half of fair coins pass that test. The ratio is therefore compared
// with those of random answers to the same procedures.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "inference/Fit.h"
#include "psychophysics/Procedure.h"

namespace heft {

/// A staircase as one person ran it.
struct AnsweredStaircase {
  std::shared_ptr<const Procedure> before;  ///< as it was before its first trial
  std::optional<int> n_trials{};            ///< none: it finished
};

/// One person's answers by level: negative, positive.
struct AnsweredLevels {
  AnswersByLevel answers;
  /// Random answers run these again. Empty: levels did not follow the answers, as where the side of
  /// a cube was random and answers count by side, and random answers are to the same levels.
  std::vector<AnsweredStaircase> staircases{};
};

/// Twice the log likelihood that a rising logistic function gains on a constant share; 0 where the
/// likeliest one falls.
double gain_of_levels(const AnswersByLevel& answers);

/// Share of simulated studies in which people who give each answer at random, as often as they did,
/// have as large a sum of gain_of_levels(); the larger of the shares where everyone answers as
/// often as they did, and where all answer equally often.
/// @param people at least one
double p_of_random_answers(std::span<const AnsweredLevels> people, std::uint64_t seed = 1);

}  // namespace heft
