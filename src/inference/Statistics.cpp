#include "inference/Statistics.h"

#include <algorithm>
#include <boost/math/distributions/beta.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <numeric>

namespace heft {

Interval Contrast::interval(double confidence) const {
  const double half = student_t_quantile(n - 1, confidence) * standard_error;
  return {value - half, value + half};
}

double Contrast::smallest_effect() const {
  constexpr double both_tails_of_80_percent_power = 0.6;
  return (student_t_quantile(n - 1) + student_t_quantile(n - 1, both_tails_of_80_percent_power)) *
         standard_error;
}

std::optional<double> mean(std::span<const double> values) {
  if (values.empty()) return std::nullopt;
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

std::optional<double> sample_sd(std::span<const double> values) {
  if (values.size() < 2) return std::nullopt;
  const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
  if (*least == *greatest) return 0;  // a rounded mean must not make equal values differ
  const double center = *mean(values);
  double sum = 0;
  for (double value : values) sum += (value - center) * (value - center);
  return std::sqrt(sum / static_cast<double>(values.size() - 1));
}

std::vector<double> slope_weights(std::span<const double> x) {
  std::vector<double> weights(x.begin(), x.end());
  const double mean_x = *mean(x);
  double square = 0;
  for (double& weight : weights) {
    weight -= mean_x;
    square += weight * weight;
  }
  for (double& weight : weights) weight /= square;
  return weights;
}

double slope(std::span<const double> x, std::span<const double> y) {
  const std::vector<double> weights = slope_weights(x);
  return std::inner_product(y.begin(), y.end(), weights.begin(), 0.0);
}

std::optional<Interval> student_t_interval(std::span<const double> values) {
  if (values.size() < 2) return std::nullopt;
  return student_t_interval(*mean(values), *sample_sd(values), static_cast<int>(values.size()));
}

Interval student_t_interval(double mean, double sd, int n) {
  const double half = student_t_quantile(n - 1) * sd / std::sqrt(n);
  return {mean - half, mean + half};
}

double student_t_quantile(double degrees_of_freedom, double confidence) {
  const boost::math::students_t t(degrees_of_freedom);
  return quantile(complement(t, (1 - confidence) / 2));
}

Interval exact_interval(double n_hits, double n_trials, double confidence) {
  using boost::math::beta_distribution;
  const double misses = n_trials - n_hits, tail = (1 - confidence) / 2;
  Interval interval{0, 1};
  if (n_hits > 0) interval.low = quantile(beta_distribution<>(n_hits, misses + 1), tail);
  if (misses > 0)
    interval.high = quantile(complement(beta_distribution<>(n_hits + 1, misses), tail));
  return interval;
}

}  // namespace heft
