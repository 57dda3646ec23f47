// One person's term in the mixed indecision model: the likelihood of their answers, integrated over
// sensitivity, criterion half-width and side bias as these are distributed over people.
//
// Adaptive Gauss-Hermite quadrature (Pinheiro & Bates 1995): the nodes lie around the person's most
// likely effects for one population; `center` puts them where another population needs them.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "inference/IndecisionLikelihood.h"
#include "inference/MaximumLikelihood.h"

namespace heft {

/// Indices of the parameters of a population. Logarithms of the sensitivity s (per unit of level)
/// and of the criterion half-width tau (SDs of internal noise) are jointly normal over people; the
/// side bias is normal around 0.
enum PopulationParameter : Eigen::Index {
  mean_log_sensitivity,
  mean_log_criterion,
  log_sd_sensitivity,  ///< logarithm of the SD of log s
  log_sd_criterion,
  arctanh_correlation,  ///< of log s and log tau
  log_sd_bias,
  shared_lapse,
  n_population_parameters
};

/// log s, log tau and bias of one person.
using PersonEffects = Eigen::Vector3d;

class PersonIntegral {
 public:
  /// @param answers by signed level, in units of the largest one
  explicit PersonIntegral(std::vector<LevelAnswers> answers);

  /// Puts the nodes around the person's most likely effects in this population.
  void center(const Parameters& population);
  /// Log of the integral. @param derivatives by the population's parameters; null: not needed
  double log_likelihood(const Parameters& population, Derivatives* derivatives);
  /// Gradient of the last log_likelihood with derivatives.
  const Parameters& score() const { return score_; }

 private:
  struct Given {  // one kind of answer at one level
    double level = 0, n = 0;
    IndecisionAnswer answer = none_answer;
  };
  struct AtNodes {  // log likelihood of the answers and its derivatives by the lapse rate
    Eigen::ArrayXd value, slope, curvature;
  };

  AtNodes at_nodes(double lapse, bool with_derivatives) const;
  void find_mode(const Parameters& population);
  void put_nodes(const Parameters& population);
  void put_shares();

  std::vector<LevelAnswers> answers_;
  std::vector<Given> given_;
  PersonEffects mode_ = PersonEffects::Zero();
  Eigen::Matrix3d curvature_ = Eigen::Matrix3d::Identity();  // minus the Hessian at the mode
  bool has_mode_ = false;
  Eigen::ArrayX3d effects_;     // of each node
  Eigen::ArrayXd log_weights_;  // of each node
  Eigen::ArrayXXd shares_;      // of attentive answers: nodes by given_
  Parameters score_;
};

}  // namespace heft
