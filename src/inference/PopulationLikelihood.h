// The likelihood of a population of people in the mixed indecision model (PersonIntegral.h): its
// maximum, profile intervals, and each person's influence on the estimate.
//
// The likelihood is multiplied by 1 - rho^2 for the correlation rho of log s and log tau, which few
// people do not identify: without this weak prior (LKJ with shape 2: Lewandowski, Kurowicka & Joe
// 2009) the estimate is often -1 or 1, and thresholds of 13 people with 20 trials each are 20 % too
// small.
#pragma once

#include <optional>
#include <vector>

#include "inference/Likelihood.h"
#include "inference/PersonIntegral.h"

namespace heft {

/// The largest lapse rate that is fitted.
inline constexpr double most_lapses = 0.2;

class PopulationLikelihood {
 public:
  /// @param people each one's answers by signed level, in units of the largest; not empty
  explicit PopulationLikelihood(const std::vector<std::vector<LevelAnswers>>& people);

  /// The highest maximum from several starts. @param lapse a fixed lapse rate; none: it is free
  Maximum maximum(std::optional<double> lapse = std::nullopt);
  /// The local maximum reached from `from`. @param held index of a fixed parameter; -1: none
  Maximum climb(Parameters from, Eigen::Index held = -1);

  struct ProfileInterval {
    std::optional<double> low, high;  ///< none: the likelihood never falls enough on that side
  };
  /// Ends where the log profile likelihood has fallen by n/2 log(1 + t^2/(n - 1)), t the 97.5 %
  /// quantile of Student's t with n - 1 degrees of freedom: exact for n people whose effects are
  /// known, and 1.92 for many.
  /// @param best replaced by a likelier point if the search finds one
  ProfileInterval interval(Maximum& best, Eigen::Index of);

  /// Whether a sensitivity of 0 lies outside the interval.
  bool excludes_no_sensitivity(const Maximum& best);

  /// By person: how the estimate of one parameter would change, to first order, if the person's
  /// answers counted twice (infinitesimal jackknife).
  std::vector<double> influences(const Maximum& best, Eigen::Index of);

  const std::vector<ParameterBounds>& bounds() const { return bounds_; }

 private:
  /// Error of the log likelihood by the quadrature.
  double of_quadrature() const { return 1e-4 * static_cast<double>(people_.size()); }
  Parameters start(double log_sensitivity) const;
  double value(const Parameters& at, Derivatives* derivatives);
  LogLikelihood log_likelihood();

  std::vector<PersonIntegral> people_;
  std::vector<ParameterBounds> bounds_;
  double n_none_ = 0, n_trials_ = 0, mean_square_level_ = 0;
};

}  // namespace heft
