// How well a model's studies predict a figure of the paper.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/math/Quantiles.h"
#include "inference/Statistics.h"
#include "results/paper/PaperStudy.h"

namespace heft {

namespace {
constexpr double even_share = 0.01;       // of the density that knows only the range
constexpr double least_bandwidth = 0.01;  // of the range
constexpr double rounding = 0.05;         // the paper prints one decimal

double kernel_density(double at, const std::vector<double>& values, double bandwidth) {
  double sum = 0;
  for (const double value : values) {
    const double z = (at - value) / bandwidth;
    sum += std::exp(-z * z / 2);
  }
  return sum / (static_cast<double>(values.size()) * bandwidth * std::sqrt(2 * std::numbers::pi));
}

double share_below(double at, const std::vector<double>& values) {
  double n = 0;
  for (const double value : values)
    n += std::abs(value - at) <= rounding ? 0.5 : value < at ? 1.0 : 0.0;
  return n / static_cast<double>(values.size());
}
}  // namespace

FigureScore summary_of(const std::vector<double>& studies) {
  FigureScore summary;
  summary.mean = mean(studies).value_or(std::nan(""));
  summary.low = quantile(studies, 0.025).value_or(std::nan(""));
  summary.high = quantile(studies, 0.975).value_or(std::nan(""));
  return summary;
}

FigureScore score_of(const PaperFigure& figure, const std::vector<double>& studies) {
  FigureScore score = summary_of(studies);
  score.place = std::nan("");
  score.log_score = std::log(even_share);
  if (studies.empty()) return score;
  score.place = share_below(figure.value, studies);
  score.hit = figure.value >= score.low - rounding && figure.value <= score.high + rounding;
  const double shrinking = std::pow(static_cast<double>(studies.size()), -0.2);
  const double bandwidth =
      std::max(1.06 * sample_sd(studies).value_or(0) * shrinking, least_bandwidth * figure.range);
  const double density = kernel_density(figure.value, studies, bandwidth);
  score.log_score = std::log((1 - even_share) * density * figure.range + even_share);
  return score;
}

}  // namespace heft
