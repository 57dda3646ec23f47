#include "psychophysics/Marginal.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace heft {

double Marginal::mean() const {
  return std::inner_product(values.begin(), values.end(), weights.begin(), 0.0);
}

double Marginal::sd() const {
  const double center = mean();
  double variance = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
    variance += weights[i] * (values[i] - center) * (values[i] - center);
  return std::sqrt(variance);
}

double Marginal::quantile(double p) const {
  double below = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double cumulative = below + weights[i];
    if (cumulative >= p) {
      if (i == 0) return values[0];
      return values[i - 1] + (values[i] - values[i - 1]) * (p - below) / weights[i];
    }
    below = cumulative;
  }
  return values.back();
}

Censored Marginal::beyond() const {
  if (values.size() < 2) return Censored::none;
  const double least_weight =
      std::exp(-1.96 * 1.96 / 2) * *std::max_element(weights.begin(), weights.end());
  const bool below = weights.front() >= least_weight, above = weights.back() >= least_weight;
  if (below && above) return Censored::indeterminate;
  return below ? Censored::below : above ? Censored::above : Censored::none;
}

Marginal Marginal::inverse(double factor) const {
  Marginal inverse{{}, {weights.rbegin(), weights.rend()}};
  for (auto value = values.rbegin(); value != values.rend(); ++value)
    inverse.values.push_back(factor / *value);
  return inverse;
}

LogWeights::LogWeights(std::vector<double> log_prior)
    : logs_(std::move(log_prior)), weights_(logs_.size()) {
  normalize();
  log_prior_sum_ = log_sum_;
}

void LogWeights::add(const std::vector<double>& log_likelihood) {
  for (std::size_t i = 0; i < logs_.size(); ++i) logs_[i] += log_likelihood[i];
  normalize();
}

void LogWeights::normalize() {
  constexpr double last_digit = -36;  // e^-36 is 2e-16
  const auto n = static_cast<Eigen::Index>(logs_.size());
  Eigen::Map<Eigen::ArrayXd> logs(logs_.data(), n), weights(weights_.data(), n);
  const double largest = logs.maxCoeff();
  logs -= largest;
  weights = logs.max(last_digit).exp();  // numbers below the normal ones would be slow
  weights = (logs > last_digit).select(weights, 0);
  const double sum = weights.sum();
  weights /= sum;
  log_scale_ += largest;
  log_sum_ = log_scale_ + std::log(sum);
}

double LogWeights::entropy() const {
  const auto n = static_cast<Eigen::Index>(logs_.size());
  const Eigen::Map<const Eigen::VectorXd> weights(weights_.data(), n), logs(logs_.data(), n);
  return log_sum_ - log_scale_ - weights.dot(logs);
}

void LevelEvidence::add(const std::array<bool, 3>& outcomes) {
  const double n = counts_[0] + counts_[1] + counts_[2];
  double probability = 0, n_possible = 0;
  for (std::size_t i = 0; i < n_outcomes_; ++i)
    if (outcomes[i]) {
      probability += (counts_[i] + 1) / (n + static_cast<double>(n_outcomes_));
      ++n_possible;
    }
  for (std::size_t i = 0; i < n_outcomes_; ++i)
    if (outcomes[i]) counts_[i] += 1 / n_possible;
  log_constant_ += std::log(probability);
}

double LevelEvidence::for_model(double log_model) const {
  const bool all_same =
      *std::max_element(counts_.begin(), counts_.end()) == counts_[0] + counts_[1] + counts_[2];
  return all_same ? 0 : log_model - log_constant_;
}

void take_finite_log(std::vector<double>& p) {
  Eigen::Map<Eigen::ArrayXd> values(p.data(), static_cast<Eigen::Index>(p.size()));
  values = values.max(std::numeric_limits<double>::min()).log();
}

Estimate threshold_estimate(const Marginal& threshold, double log_bayes_factor) {
  Estimate estimate;
  if (threshold.values.size() < 2) return estimate;  // fixed, not estimated
  if (log_bayes_factor < std::log(3)) {
    estimate.censored = Censored::indeterminate;
    return estimate;
  }
  estimate.censored = threshold.beyond();
  const bool none = estimate.censored == Censored::none;
  if (none || estimate.censored == Censored::above) estimate.low = threshold.low();
  if (none || estimate.censored == Censored::below) estimate.high = threshold.high();
  if (!none) return estimate;
  estimate.value = threshold.mean();
  estimate.sd = threshold.sd();
  return estimate;
}

}  // namespace heft
