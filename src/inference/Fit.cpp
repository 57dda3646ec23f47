#include "inference/Fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace heft {

const FittedParameter& Fit::parameter(std::string_view name) const {
  return *std::ranges::find(parameters, name, &FittedParameter::name);
}

std::array<double, 3> totals(const AnswersByLevel& answers) {
  std::array<double, 3> sum{};
  for (const auto& [level, n] : answers)
    for (std::size_t k = 0; k < n.size(); ++k) sum[k] += n[k];
  return sum;
}

LevelReach reach_of(const AnswersByLevel& answers) {
  const double largest_g = largest_level_of(answers);
  if (answers.empty()) return {largest_g};
  const double range_g = answers.rbegin()->first - answers.begin()->first;
  return {std::min(largest_g, range_g), range_g < largest_g};
}

double trials_in(const AnswersByLevel& answers) {
  const auto [first, second, third] = totals(answers);
  return first + second + third;
}

double largest_level_of(const AnswersByLevel& answers) {
  if (answers.empty()) return 0;
  return std::max(std::abs(answers.begin()->first), std::abs(answers.rbegin()->first));
}

std::string too_little(const AnswersByLevel& answers) {
  const double n = trials_in(answers);
  if (n == 0) return "there are no trials";
  if (std::ranges::count(totals(answers), 0.0) == 2)
    return "all answers are the same: they don't say where others begin";
  if (answers.size() == 1)
    return fmt::format("there is one level, {:g}: a slope needs two levels or more",
                       answers.begin()->first);
  if (n < least_trials_to_fit)
    return fmt::format("{:g} trials are too few, expected {:g} at least", n, least_trials_to_fit);
  return "";
}

std::string too_little_chosen(const AnswersByLevel& answers) {
  const auto [first, none, last] = totals(answers);
  if (none > 0 && first + last == 0)
    return "no cube was ever chosen: a criterion beyond all levels shown explains that, "
           "whatever the sensitivity";
  return too_little(answers);
}

namespace {
// Largest log likelihood of one level's answers if the answers outside first...last have their
// smallest probabilities.
double log_likelihood_of(const std::array<double, 3>& n, std::span<const double> least,
                         std::size_t first, std::size_t last) {
  std::array<double, 3> share{};
  std::array<bool, 3> at_least{};
  for (std::size_t k = 0; k < least.size(); ++k) at_least[k] = k < first || k > last;
  for (bool changed = true; changed;) {  // raises shares below their smallest value to it
    double mass = 1, n_left = 0;
    for (std::size_t k = 0; k < least.size(); ++k) at_least[k] ? mass -= least[k] : n_left += n[k];
    changed = false;
    for (std::size_t k = 0; k < least.size(); ++k) {
      share[k] = at_least[k] ? least[k] : n_left > 0 ? mass * n[k] / n_left : mass;
      if (share[k] < least[k]) changed = at_least[k] = true;
    }
  }
  double sum = 0;
  for (std::size_t k = 0; k < least.size(); ++k) sum += log_share(n[k], share[k]).value;
  return sum;
}
}  // namespace

// Dynamic programming over ascending levels; best[k]: the largest log likelihood so far if the last
// answer that is given at this level is k.
double log_likelihood_of_steps(const AnswersByLevel& answers, std::span<const double> least) {
  constexpr double none = -std::numeric_limits<double>::infinity();
  std::array<double, 3> best{0, none, none};
  for (const auto& [level, n] : answers) {
    std::array<double, 3> next{none, none, none};
    double before = none;
    for (std::size_t first = 0; first < least.size(); ++first) {
      before = std::max(before, best[first]);
      for (std::size_t last = first; last < least.size(); ++last)
        next[last] = std::max(next[last], before + log_likelihood_of(n, least, first, last));
    }
    best = next;
  }
  return *std::ranges::max_element(best);
}

LogShare log_share(double n, double p) {
  if (n == 0) return {0, 0, 0};
  const double share = std::max(p, 1e-300);
  return {n * std::log(share), n / share, -n / share / share};
}

std::string why_no_threshold(const SensitivityRange& range, const LevelReach& reach) {
  const auto& [low, high] = range;
  if (range.flat())
    return "flat likelihood: nearly all answers are the same, so that any sensitivity fits; a "
           "criterion lies beyond all levels shown";
  if (range.separated())
    return "separation: the answers change almost only between neighboring levels, so that any "
           "large sensitivity fits within 95 %; show levels in between";
  if (high && *high < 0) return "negative sensitivity: larger levels were answered as smaller";
  if (!low || *low <= 0) return "no reliable sensitivity: its 95 % interval contains 0";
  if (z_75 / *low > 2 * reach.level_g)
    return fmt::format(
        "the threshold's 95 % interval reaches to {:.{}f} g, beyond twice the {} shown",
        z_75 / *low, z_75 / *low < 100 ? 1 : 0,
        reach.is_range ? "range of levels" : "largest level");
  return "";
}

}  // namespace heft
