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
// log of normal_cdf, also where that is 0 by the digits.
double log_normal_cdf(double z) {
  if (z > -30) return std::log(normal_cdf(z));
  return -z * z / 2 - std::log(-z) - 0.9189385332046727;  // log sqrt(2 pi); Mills' ratio
}

// Where a function with one hill is highest.
template <typename Function>
double highest(Function function, double low, double high) {
  constexpr int bits = std::numeric_limits<double>::digits / 2;  // beyond, rounding dominates
  const auto below = [&](double at) { return -function(at); };
  return boost::math::tools::brent_find_minima(below, low, high, bits).first;
}

/// The values shifted and scaled, so that the exact ones have mean 0 and SD 1.
class Tobit {
 public:
  Tobit(std::span<const CensoredValue> values, double center, double scale)
      : values_(values.begin(), values.end()) {
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

  double profile(double mu) const { return log_likelihood(mu, best_log_sigma(mu)); }

  double best_mu() const {
    return highest([&](double mu) { return profile(mu); }, -20.0, 20.0);
  }

  // From the best mu outwards, to where the profile has fallen by so much.
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
}  // namespace

bool mostly_censored(std::span<const CensoredValue> values, int n_missing) {
  const auto n = values.size() + static_cast<std::size_t>(n_missing);
  return n == 0 || 2 * exact_values(values).size() <= n;
}

std::optional<CensoredMean> censored_mean(std::span<const CensoredValue> values, int n_missing) {
  const std::vector<double> exact = exact_values(values);
  const double sd = sample_sd(exact).value_or(0);
  if (mostly_censored(values, n_missing) || !(sd > 0)) return std::nullopt;
  const double center = *mean(exact);
  if (exact.size() == values.size()) return CensoredMean{center, sd, *student_t_interval(exact)};
  const Tobit tobit(values, center, sd);
  const double n = static_cast<double>(values.size()), best = tobit.best_mu();
  const double drop = allowed_drop(static_cast<double>(exact.size()));
  return CensoredMean{
      center + sd * best,
      sd * std::exp(tobit.best_log_sigma(best)) * std::sqrt(n / (n - 1)),
      {center + sd * tobit.end(best, drop, -1), center + sd * tobit.end(best, drop, +1)}};
}

FigureSummary summarize_figures(std::span<const CensoredValue> values, int n_missing) {
  if (mostly_censored(values, n_missing)) return {};
  const std::vector<double> exact = exact_values(values);
  const MeanKind kind = exact.size() == values.size() ? MeanKind::mean : MeanKind::tobit_mean;
  if (const auto found = censored_mean(values, n_missing))
    return {kind, found->mean, found->sd, found->interval};
  if (kind == MeanKind::mean) return {kind, mean(exact), sample_sd(exact), std::nullopt};
  return {};  // the exact ones are all the same
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
