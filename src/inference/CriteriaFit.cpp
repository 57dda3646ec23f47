#include "inference/CriteriaFit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "inference/PooledSensitivity.h"
#include "psychophysics/ObserverModels.h"

namespace heft {

namespace {
// The log likelihood of one person's answers, and its derivatives by the criteria.
struct CriteriaLikelihood {
  double value = 0;
  double by_log_indecision = 0, by_bias = 0;
  std::array<double, 3> information{};  // Fisher's: of log indecision, of bias, of both
};

CriteriaLikelihood likelihood(std::span<const SidedAnswers> answers, double sensitivity,
                              const Criteria& at) {
  constexpr double third = fixed_lapse / 3, seen = 1 - fixed_lapse;
  const double indecision = std::exp(at.log_indecision);
  CriteriaLikelihood sum;
  for (const SidedAnswers& n : answers) {
    const double felt = sensitivity * n.level + at.bias;
    const double up = felt - indecision, down = felt + indecision;
    const double right = third + seen * normal_cdf(up), left = third + seen * normal_cdf(-down);
    const double none = std::max(1 - right - left, third);
    const double right_slope = seen * normal_density(up), left_slope = seen * normal_density(down);
    sum.value += n.right * std::log(right) + n.left * std::log(left) + n.none * std::log(none);
    const double a = n.right / right - n.none / none, b = n.left / left - n.none / none;
    sum.by_bias += a * right_slope - b * left_slope;
    sum.by_log_indecision -= a * right_slope + b * left_slope;
    const double n_all = n.right + n.left + n.none;
    const double apart = left_slope + right_slope, aside = left_slope - right_slope;
    const double rr = right_slope * right_slope / right, ll = left_slope * left_slope / left;
    sum.information[0] += n_all * (rr + ll + apart * apart / none);
    sum.information[1] += n_all * (rr + ll + aside * aside / none);
    sum.information[2] += n_all * (ll - rr + apart * aside / none);
  }
  sum.by_log_indecision *= indecision;
  sum.information[0] *= indecision * indecision;
  sum.information[2] *= indecision;
  return sum;
}

// The same times the density that the spread gives to the criteria.
CriteriaLikelihood posterior(std::span<const SidedAnswers> answers, double sensitivity,
                             const Criteria& at, const Spread& spread) {
  CriteriaLikelihood sum = likelihood(answers, sensitivity, at);
  const double precision = 1 / (spread.sd_log_indecision * spread.sd_log_indecision);
  const double bias_precision = 1 / (spread.sd_bias * spread.sd_bias);
  const double off = at.log_indecision - spread.mean_log_indecision;
  sum.value -= (precision * off * off + bias_precision * at.bias * at.bias) / 2;
  sum.by_log_indecision -= precision * off;
  sum.by_bias -= bias_precision * at.bias;
  sum.information[0] += precision;
  sum.information[1] += bias_precision;
  return sum;
}

double determinant(const CriteriaLikelihood& at) {
  return at.information[0] * at.information[1] - at.information[2] * at.information[2];
}

// Fisher scoring with steps that shorten until they help. @param at where to begin, then the best
CriteriaLikelihood maximize(std::span<const SidedAnswers> answers, double sensitivity,
                            const Spread& spread, Criteria& at) {
  constexpr double good_enough = 1e-5;
  CriteriaLikelihood here = posterior(answers, sensitivity, at, spread);
  for (int i = 0; i < 30; ++i) {
    const auto [a, d, both] = here.information;
    const double det = determinant(here);
    const double to_indecision = (d * here.by_log_indecision - both * here.by_bias) / det;
    const double to_bias = (a * here.by_bias - both * here.by_log_indecision) / det;
    if (to_indecision * here.by_log_indecision + to_bias * here.by_bias < good_enough) break;
    double length = std::min(1.0, 1.5 / (std::abs(to_indecision) + 1e-9));
    bool better = false;
    for (int halvings = 0; halvings < 12 && !better; ++halvings, length /= 2) {
      const Criteria there{at.log_indecision + length * to_indecision, at.bias + length * to_bias};
      const CriteriaLikelihood next = posterior(answers, sensitivity, there, spread);
      better = next.value > here.value;
      if (!better) continue;
      at = there;
      here = next;
    }
    if (!better) break;
  }
  return here;
}

}  // namespace

LikelyCriteria likely_criteria(PersonAnswers& person, double sensitivity, const Spread& spread) {
  const CriteriaLikelihood best = maximize(person.answers, sensitivity, spread, person.criteria);
  const double det = determinant(best);
  LikelyCriteria likely;
  likely.log_likelihood =
      best.value - std::log(det) / 2 - std::log(spread.sd_log_indecision * spread.sd_bias);
  likely.log_indecision = person.criteria.log_indecision;
  likely.variance = best.information[1] / det;
  likely.bias_square = person.criteria.bias * person.criteria.bias + best.information[0] / det;
  const double variance_between = spread.sd_log_indecision * spread.sd_log_indecision;
  likely.information = person.information = std::max(1 - likely.variance / variance_between, 0.0);
  return likely;
}

void SpreadSums::add(const LikelyCriteria& person, double weight) {
  n_ += weight;
  sum_ += weight * person.log_indecision;
  square_ += weight * (person.log_indecision * person.log_indecision + person.variance);
  bias_square_ += weight * person.bias_square;
  information_ += weight * person.information;
}

Spread SpreadSums::after(const Spread& last) const {
  if (!(n_ > 0)) return last;
  constexpr double min_information = 0.05;
  Spread next = last;
  // Each person's was drawn towards the last mean, and all of it by its information: undone, so
  // that the mean gets there in a step or two where EM's own would take dozens.
  const double moved =
      (sum_ / n_ - last.mean_log_indecision) / std::max(information_ / n_, min_information);
  next.mean_log_indecision =
      std::clamp(last.mean_log_indecision + std::clamp(moved, -1.0, 1.0), -3.0, 6.0);
  const double variance = square_ / n_ - sum_ / n_ * sum_ / n_;
  next.sd_log_indecision = std::clamp(std::sqrt(std::max(variance, 0.0)), 0.1, 1.5);
  next.sd_bias = std::clamp(std::sqrt(bias_square_ / n_), 0.05, 2.0);
  return next;
}

std::vector<double> fit_criteria(std::vector<PersonAnswers>& people, double sensitivity,
                                 Spread& spread) {
  constexpr int n_steps = 4;
  std::vector<double> values;
  SpreadSums sums;
  for (int step = 0; step < n_steps; ++step) {
    if (step > 0) spread = sums.after(spread);
    sums = {};
    values.clear();
    for (PersonAnswers& person : people) {
      const LikelyCriteria likely = likely_criteria(person, sensitivity, spread);
      values.push_back(likely.log_likelihood);
      sums.add(likely);
    }
  }
  return values;
}

void move_criteria(std::vector<PersonAnswers>& people, Spread& spread, double growth) {
  if (growth <= 1 || !std::isfinite(growth)) return;
  const double more = std::log(growth);
  for (PersonAnswers& person : people) person.criteria.log_indecision += more;
  spread.mean_log_indecision += more;
}

}  // namespace heft
