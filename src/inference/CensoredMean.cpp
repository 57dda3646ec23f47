#include "inference/CensoredMean.h"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "psychophysics/ObserverModels.h"

namespace heft {

namespace {
// log of normal_cdf, also where normal_cdf underflows to 0.
double log_normal_cdf(double z) {
  if (z > -30) return std::log(normal_cdf(z));
  return -z * z / 2 - std::log(-z) - 0.9189385332046727;  // log sqrt(2 pi); Mills' ratio
}

// The maximum of a function with a single local maximum.
template <typename Function>
double highest(Function function, double low, double high) {
  constexpr int bits = std::numeric_limits<double>::digits / 2;  // beyond, rounding dominates
  const auto below = [&](double at) { return -function(at); };
  return boost::math::tools::brent_find_minima(below, low, high, bits).first;
}

/// The values shifted and scaled, so that the exact ones have mean 0 and SD 1. What is estimated is
/// mu + slope sigma^2: with a slope of 0 the mean, with half the scale the logarithm of the mean of
/// figures whose logarithms are the values, in the same units.
class Tobit {
 public:
  Tobit(std::span<const CensoredValue> values, double center, double scale, double slope)
      : values_(values.begin(), values.end()), slope_(slope) {
    for (CensoredValue& value : values_) value.value = (value.value - center) / scale;
  }

  double log_likelihood(double mu, double log_sigma) const {
    const double sigma = std::exp(log_sigma);
    double sum = 0;
    for (const CensoredValue& value : values_) {
      const double z = (value.value - mu) / sigma;
      if (value.censored == Censored::none)
        sum += -log_sigma - z * z / 2;
      else
        sum += log_normal_cdf(value.censored == Censored::above ? -z : z);
    }
    return sum;
  }

  double best_log_sigma(double mu) const {
    return highest([&](double log_sigma) { return log_likelihood(mu, log_sigma); }, -4.0, 6.0);
  }

  double best_mu() const {
    return highest([&](double mu) { return log_likelihood(mu, best_log_sigma(mu)); }, -20.0, 20.0);
  }

  double target(double mu, double log_sigma) const { return mu + slope_ * std::exp(2 * log_sigma); }

  double profile(double target_at) const {
    const auto along = [&](double log_sigma) {
      return log_likelihood(target_at - slope_ * std::exp(2 * log_sigma), log_sigma);
    };
    return along(highest(along, -4.0, 6.0));
  }

  // The value beyond `best` at which the profile has fallen by `drop`.
  double end(double best, double drop, double direction) const {
    const double least = profile(best) - drop;
    double inside = 0, outside = 0.5;
    while (profile(best + direction * outside) > least && outside < 1e6)
      inside = std::exchange(outside, 2 * outside);
    for (int i = 0; i < 34; ++i) {
      const double middle = (inside + outside) / 2;
      (profile(best + direction * middle) > least ? inside : outside) = middle;
    }
    return best + direction * inside;
  }

 private:
  std::vector<CensoredValue> values_;
  double slope_;
};

std::vector<double> exact_values(std::span<const CensoredValue> values) {
  std::vector<double> exact;
  for (const CensoredValue& value : values)
    if (value.censored == Censored::none) exact.push_back(value.value);
  return exact;
}

double allowed_drop(double n_exact) {
  const double t = student_t_quantile(n_exact - 1);
  return n_exact / 2 * std::log1p(t * t / (n_exact - 1));
}
// Logarithms. A value of 0 or less counts as below the smallest positive one; if it is censored
// above, it is left out.
std::vector<CensoredValue> logarithms(std::span<const CensoredValue> values) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const CensoredValue& one : values)
    if (one.value > 0) smallest = std::min(smallest, one.value);
  std::vector<CensoredValue> logs;
  for (const CensoredValue& one : values)
    if (one.value > 0)
      logs.push_back({std::log(one.value), one.censored});
    else if (one.censored != Censored::above && std::isfinite(smallest))
      logs.push_back({std::log(smallest), Censored::below});
  return logs;
}

// The mean, SD and interval of figures from those of their logarithms: mu and sigma, and the limits
// of the mean's logarithm.
std::optional<CensoredMean> of_logarithms(double log_mean, double sigma, Interval log_interval) {
  const double mean = std::exp(log_mean);
  const CensoredMean found{mean,
                           mean * std::sqrt(std::expm1(sigma * sigma)),
                           {std::exp(log_interval.low), std::exp(log_interval.high)}};
  constexpr double widest = 1e5;
  const bool is_bounded = found.interval.high < widest * found.interval.low;
  return is_bounded && std::isfinite(found.sd) ? std::optional(found) : std::nullopt;
}

// Requires more than half of the values to be exact.
std::optional<CensoredMean> tobit_mean(std::span<const CensoredValue> values,
                                       const std::vector<double>& exact, FigureModel model) {
  const double center = *mean(exact), scale = *sample_sd(exact);
  const bool is_log = model == FigureModel::log_normal;
  const Tobit tobit(values, center, scale, is_log ? scale / 2 : 0);
  const double n = static_cast<double>(values.size());
  const double mu = tobit.best_mu(), log_sigma = tobit.best_log_sigma(mu);
  const double best = tobit.target(mu, log_sigma);
  const double drop = allowed_drop(static_cast<double>(exact.size()));
  const double sd = scale * std::exp(log_sigma) * std::sqrt(n / (n - 1));
  const Interval interval{center + scale * tobit.end(best, drop, -1),
                          center + scale * tobit.end(best, drop, +1)};
  if (is_log) return of_logarithms(center + scale * best, sd, interval);
  return CensoredMean{center + scale * best, sd, interval};
}
}  // namespace

bool mostly_censored(std::span<const CensoredValue> values, int n_missing) {
  const auto n = values.size() + static_cast<std::size_t>(n_missing);
  return n == 0 || 2 * exact_values(values).size() <= n;
}

std::optional<CensoredMean> censored_mean(std::span<const CensoredValue> values, int n_missing,
                                          FigureModel model) {
  const bool is_log = model == FigureModel::log_normal;
  const std::vector<CensoredValue> logs =
      is_log ? logarithms(values) : std::vector<CensoredValue>();
  const std::span<const CensoredValue> modeled = is_log ? std::span(logs) : values;
  const int n_unknown = n_missing + static_cast<int>(values.size() - modeled.size());
  const std::vector<double> exact = exact_values(modeled);
  if (mostly_censored(modeled, n_unknown) || !(sample_sd(exact).value_or(0) > 0))
    return std::nullopt;
  if (is_log && exact.size() < 3) return std::nullopt;
  if (!is_log && exact.size() == values.size())
    return CensoredMean{*mean(exact), *sample_sd(exact), *student_t_interval(exact)};
  return tobit_mean(modeled, exact, model);
}

FigureSummary summarize_figures(std::span<const CensoredValue> values, int n_missing,
                                FigureModel model) {
  if (mostly_censored(values, n_missing)) return {};
  const std::vector<double> exact = exact_values(values);
  const bool all_exact = exact.size() == values.size();
  const MeanKind kind = model == FigureModel::log_normal ? MeanKind::log_normal_mean
                        : all_exact                      ? MeanKind::mean
                                                         : MeanKind::tobit_mean;
  if (const auto found = censored_mean(values, n_missing, model))
    return {kind, found->mean, found->sd, found->interval};
  if (all_exact) return {MeanKind::mean, mean(exact), sample_sd(exact), std::nullopt};
  return {};
}

std::optional<CensoredValue> mean_figure(std::span<const std::optional<CensoredValue>> figures) {
  if (figures.empty()) return std::nullopt;
  CensoredValue sum;
  for (const auto& figure : figures) {
    if (!figure) return std::nullopt;
    sum.value += figure->value / static_cast<double>(figures.size());
    if (figure->censored == Censored::none) continue;
    if (sum.censored != Censored::none && sum.censored != figure->censored) return std::nullopt;
    sum.censored = figure->censored;
  }
  return sum;
}

std::optional<CensoredValue> difference(const std::optional<CensoredValue>& first,
                                        const std::optional<CensoredValue>& second) {
  if (!first || !second) return std::nullopt;
  CensoredValue negative{-second->value, second->censored};
  if (second->censored == Censored::above) negative.censored = Censored::below;
  if (second->censored == Censored::below) negative.censored = Censored::above;
  const std::array<std::optional<CensoredValue>, 2> both{*first, negative};
  auto half = mean_figure(both);
  if (half) half->value *= 2;
  return half;
}

}  // namespace heft
