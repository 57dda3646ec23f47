// The posterior distribution of one parameter on its grid: mean, spread, interval, and whether the
// grid is wide enough for it. Also whether the responses depend on the level at all.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "psychophysics/ProcedureTypes.h"

namespace heft {

struct Marginal {
  std::vector<double> values;   ///< ascending
  std::vector<double> weights;  ///< at least 0, sum 1

  double mean() const;
  double sd() const;
  /// Interpolated between the values in their cumulative weights; the first value for smaller p.
  double quantile(double p) const;
  double low() const { return quantile(0.025); }  ///< of the central 95 % interval
  double high() const { return quantile(0.975); }
  /// Whether the distribution ends at an end of the grid: the weight there is at least what a
  /// normal distribution has at the ends of its 95 % interval, exp(-1.96^2 / 2) of the largest.
  Censored beyond() const;
  /// Distribution of factor / v for a value v; factor and all values are above 0.
  Marginal inverse(double factor) const;
};

/// A distribution over the points of a grid. Log probabilities are kept, so that thousands of
/// trials and contradictory responses neither underflow nor give NaN.
class LogWeights {
 public:
  /// @param log_prior up to a constant
  explicit LogWeights(std::vector<double> log_prior);
  /// @param log_likelihood of a response, finite
  void add(const std::vector<double>& log_likelihood);

  /// Sum 1; 0 for a point whose weight is below the last digit of the largest.
  const std::vector<double>& weights() const { return weights_; }
  double entropy() const;                                            ///< in nats
  double log_evidence() const { return log_sum_ - log_prior_sum_; }  ///< of all responses

 private:
  void normalize();

  std::vector<double> logs_;  ///< relative to the largest
  std::vector<double> weights_;
  double log_scale_ = 0;  ///< log of the largest
  double log_sum_ = 0, log_prior_sum_ = 0;
};

/// Compares two explanations of the responses: the model with its prior, and responses with
/// constant probabilities that do not depend on the level (uniform prior over them; Laplace's rule
/// of succession). A participant who answers at random has no threshold.
class LevelEvidence {
 public:
  explicit LevelEvidence(std::size_t n_outcomes) : n_outcomes_(n_outcomes) {}

  /// @param outcomes that the response can be
  void add(const std::array<bool, 3>& outcomes);
  /// Log Bayes factor in favor of the model; 0 where all responses are the same, which say nothing
  /// about how the responses depend on the level. @param log_model log probability of all responses
  double for_model(double log_model) const;

 private:
  std::size_t n_outcomes_;
  std::array<double, 3> counts_{};
  double log_constant_ = 0;
};

/// When a Bayesian procedure ends: after a number of trials, or when the 95 % interval of its
/// estimate is narrow enough. An estimate that is not identifiable is not precise, however narrow
/// its posterior.
struct PosteriorStop {
  int trials = 0;
  std::optional<double> ci_width{};

  /// @param estimate made where a width ends the procedure
  template <typename MakeEstimate>
  std::optional<StopReason> after(int n_trials, const MakeEstimate& estimate) const {
    if (ci_width) {
      const Estimate now = estimate();
      if (now.value && *now.high - *now.low <= *ci_width) return StopReason::precision;
    }
    if (n_trials >= trials) return StopReason::trials;
    return std::nullopt;
  }
  std::optional<int> planned_trials() const {
    return ci_width ? std::nullopt : std::optional(trials);
  }
};

/// Replaces probabilities by their logs, finite: an impossible response counts against a point of a
/// grid without excluding it.
void take_finite_log(std::vector<double>& p);

/// Posterior mean and 95 % interval of a threshold. Without a value, as Censored::indeterminate,
/// unless the responses depend on the level: a Bayes factor of 3 ("substantial", Jeffreys 1961).
/// Where the posterior reaches an end of the grid, only the other end of the interval is known.
Estimate threshold_estimate(const Marginal& threshold, double log_bayes_factor);

}  // namespace heft
