// The likelihood of answers in the indecision model at one level, with its derivatives: what the
// fit of one file (IndecisionFit.cpp) and the mixed model over people (MixedIndecision.h) share.
// Implemented in IndecisionFit.cpp.
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "psychophysics/ObserverModels.h"

namespace heft {

/// Places of the answers in a level's counts.
enum IndecisionAnswer : std::size_t { reference_answer, none_answer, comparison_answer };

/// How often each answer was given at one level.
struct LevelAnswers {
  double level = 0;
  std::array<double, 3> n{};
};

/// Log likelihood of one level's answers, and its derivatives by the three quantities on which it
/// depends: up = felt - criterion, down = felt + criterion, and the lapse rate.
struct LevelLikelihood {
  double value = 0;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
};

/// @param before log likelihood of the levels before, to which each answer's is added in turn: a
///   sum in another order would differ in the last digits
double level_log_likelihood(const IndecisionParameters& parameters, const LevelAnswers& answers,
                            double before);
LevelLikelihood level_likelihood(const IndecisionParameters& parameters,
                                 const LevelAnswers& answers, double before = 0);

}  // namespace heft
