#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "inference/Fit.h"
#include "inference/IndecisionLikelihood.h"
#include "inference/MaximumLikelihood.h"
#include "inference/checks/GoodnessOfFit.h"
#include "psychophysics/ObserverModels.h"

namespace heft {

namespace {
// Probabilities of the answers that were given only: most levels of a staircase have one answer,
// and the others' probabilities would take as long.
IndecisionShares shares_of_given(const IndecisionParameters& parameters,
                                 const LevelAnswers& answers) {
  if (answers.n[none_answer] > 0) return indecision_shares(parameters, answers.level);
  const double felt = parameters.sensitivity * answers.level + parameters.bias;
  const auto share = [&](double z) {
    return parameters.lapse / 3 + (1 - parameters.lapse) * normal_cdf(z);
  };
  return {answers.n[reference_answer] > 0 ? share(-felt - parameters.indecision) : 0, 0,
          answers.n[comparison_answer] > 0 ? share(felt - parameters.indecision) : 0};
}

std::array<LogShare, 3> log_shares(const LevelAnswers& answers, const IndecisionShares& p) {
  return {log_share(answers.n[reference_answer], p.reference),
          log_share(answers.n[none_answer], p.none),
          log_share(answers.n[comparison_answer], p.comparison)};
}
}  // namespace

double level_log_likelihood(const IndecisionParameters& parameters, const LevelAnswers& answers,
                            double before) {
  double sum = before;
  for (const LogShare& share : log_shares(answers, shares_of_given(parameters, answers)))
    sum += share.value;
  return sum;
}

LevelLikelihood level_likelihood(const IndecisionParameters& parameters,
                                 const LevelAnswers& answers, double before) {
  const IndecisionShares p = shares_of_given(parameters, answers);
  const std::array<LogShare, 3> shares = log_shares(answers, p);
  const double felt = parameters.sensitivity * answers.level + parameters.bias;
  const double up = felt - parameters.indecision, down = felt + parameters.indecision;
  const double attentive = 1 - parameters.lapse;
  const double up_density = normal_density(up), down_density = normal_density(down);
  // How the probabilities of the answers change with up, down and the lapse rate.
  const double to_up = attentive * up_density, to_down = attentive * down_density;
  const auto by_lapse = [&](double share) { return (1.0 / 3 - share) / attentive; };
  const std::array<Eigen::Vector3d, 3> slopes{Eigen::Vector3d(0, -to_down, by_lapse(p.reference)),
                                              Eigen::Vector3d(-to_up, to_down, by_lapse(p.none)),
                                              Eigen::Vector3d(to_up, 0, by_lapse(p.comparison))};
  LevelLikelihood found{before};
  for (std::size_t k = 0; k < shares.size(); ++k) {
    found.value += shares[k].value;
    if (shares[k].slope == 0) continue;  // not given
    found.first += shares[k].slope * slopes[k];
    found.second += shares[k].curvature * slopes[k] * slopes[k].transpose();
  }
  const double at_up = shares[comparison_answer].slope - shares[none_answer].slope;
  const double at_down = shares[none_answer].slope - shares[reference_answer].slope;
  found.second(0, 0) -= at_up * up * to_up;
  found.second(1, 1) -= at_down * down * to_down;
  found.second(0, 2) = found.second(2, 0) -= at_up * up_density;
  found.second(1, 2) = found.second(2, 1) -= at_down * down_density;
  return found;
}

namespace {
enum Unknown : Eigen::Index { sensitivity, indecision, bias, lapse };
constexpr std::array<const char*, 4> indecision_names{"sensitivity", "indecision", "bias", "lapse"};

constexpr double most_free_lapse = 0.5;

/// The search's axis of levels: from their mean, so that sensitivity and bias are not collinear if
/// levels are far from 0, and in units of the largest distance from it.
struct LevelAxis {
  explicit LevelAxis(const AnswersByLevel& answers) {
    const double n_trials = trials_in(answers);
    for (const auto& [level, n] : answers) mean_g += level * ((n[0] + n[1] + n[2]) / n_trials);
    const double furthest_g = std::max(std::abs(answers.begin()->first - mean_g),
                                       std::abs(answers.rbegin()->first - mean_g));
    if (furthest_g > 0) unit_g = furthest_g;
  }
  /// Rounded, because a distant origin changes the last digits: with several local maxima, or one
  /// at infinity, they decide where a search ends.
  double operator()(double level_g) const {
    constexpr double steps = 1LL << 33;
    return std::round((level_g - mean_g) / unit_g * steps) / steps;
  }

  double mean_g = 0, unit_g = 1;
};

std::vector<LevelAnswers> levels_of(const AnswersByLevel& answers, const LevelAxis& axis) {
  std::vector<LevelAnswers> levels;
  for (const auto& [level_g, n] : answers) levels.push_back({axis(level_g), n});
  return levels;
}

// Sensitivity and bias are on the axis: bias is the percept at the mean level.
double log_likelihood(std::span<const LevelAnswers> levels, const Parameters& at,
                      Derivatives* derivatives) {
  const IndecisionParameters parameters{at[sensitivity], at[indecision], at[bias], at[lapse]};
  double sum = 0;
  if (!derivatives) {
    for (const LevelAnswers& level : levels) sum = level_log_likelihood(parameters, level, sum);
    return sum;
  }
  Eigen::Vector4d gradient = Eigen::Vector4d::Zero();
  Eigen::Matrix4d hessian = Eigen::Matrix4d::Zero();
  for (const LevelAnswers& answers : levels) {
    const LevelLikelihood by = level_likelihood(parameters, answers, sum);
    sum = by.value;
    const double x = answers.level;
    Eigen::Matrix<double, 4, 3> change;  // of up, down and the lapse rate with each parameter
    change << x, x, 0, -1, 1, 0, 1, 1, 0, 0, 0, 1;
    gradient += change.lazyProduct(by.first);
    hessian += change.lazyProduct(by.second).eval().lazyProduct(change.transpose());
  }
  *derivatives = {gradient, hessian};
  return sum;
}

// At most four places between levels, on the axis.
std::vector<double> cuts_between(const AnswersByLevel& answers, const LevelAxis& axis) {
  constexpr std::size_t most = 4;
  std::vector<double> between;
  for (auto level = answers.begin(); std::next(level) != answers.end(); ++level)
    between.push_back(axis((level->first + std::next(level)->first) / 2));
  if (between.size() <= most) return between;
  std::vector<double> few;
  for (std::size_t i = 0; i < most; ++i)
    few.push_back(between[(2 * i + 1) * between.size() / (2 * most)]);
  return few;
}

// Starts near steps, with the criteria between levels: searches from afar may end in flat parts or
// at other local maxima.
std::vector<Parameters> steep_starts(const AnswersByLevel& answers, const LevelAxis& axis) {
  constexpr double steep = 40;
  std::vector<Parameters> all;
  const std::vector<double> cuts = cuts_between(answers, axis);
  for (std::size_t low = 0; low < cuts.size(); ++low)
    for (std::size_t high = low; high < cuts.size(); ++high)
      for (const double at_lapse : {0.02, 0.2, 0.45})
        all.emplace_back(Eigen::Vector4d(steep, steep * (cuts[high] - cuts[low]) / 2,
                                         -steep * (cuts[high] + cuts[low]) / 2, at_lapse));
  return all;
}

std::vector<std::vector<Parameters>> starts(const AnswersByLevel& answers, const LevelAxis& axis,
                                            const ParameterBounds& lapses) {
  const auto n = totals(answers);
  const double undecided = std::clamp(n[none_answer] / trials_in(answers), 0.02, 0.98);
  const double half_width = normal_quantile((1 + undecided) / 2);
  if (lapses.high == 0)  // log-concave (Pratt 1981)
    return {{Parameters(Eigen::Vector4d(0, half_width, 0, 0))}};
  std::vector<std::vector<Parameters>> all;
  std::vector<double> some_lapses{lapses.low};
  if (!lapses.fixed()) some_lapses = {0.02, 0.2};
  for (const double at_sensitivity : {-4.0, 0.0, 1.0, 4.0, 16.0}) {
    all.emplace_back();
    for (const double wider : {1.0, 3.0})
      for (const double at_lapse : some_lapses)
        all.back().emplace_back(Eigen::Vector4d(at_sensitivity, half_width * wider, 0, at_lapse));
  }
  if (std::vector<Parameters> steep = steep_starts(answers, axis);
      !lapses.fixed() && !steep.empty())
    all.push_back(std::move(steep));
  return all;
}

LikelihoodFit maximize_turned(const std::vector<LevelAnswers>& levels, const Eigen::Matrix4d& turn,
                              const std::vector<ParameterBounds>& bounds,
                              std::vector<std::vector<Parameters>> starts) {
  for (std::vector<Parameters>& group : starts)
    for (Parameters& start : group) start = turn * start;
  return maximize_likelihood(
      [&](const Parameters& at, Derivatives* derivatives) {
        const double value = log_likelihood(levels, turn.transpose() * at, derivatives);
        if (derivatives)
          *derivatives = {turn * derivatives->gradient,
                          turn * derivatives->hessian * turn.transpose()};
        return value;
      },
      bounds, starts);
}

// Rotation after which the bias at level 0, sensitivity * zero + bias, is one of the axes.
Eigen::Matrix4d turn_to(double zero) {
  const double length = std::hypot(1, zero);
  Eigen::Matrix4d turn = Eigen::Matrix4d::Identity();
  turn(sensitivity, sensitivity) = turn(bias, bias) = 1 / length;
  turn(bias, sensitivity) = zero / length;
  turn(sensitivity, bias) = -zero / length;
  return turn;
}

Parameters values(const LikelihoodFit& fit) {
  Parameters all(indecision_names.size());
  for (std::size_t i = 0; i < indecision_names.size(); ++i)
    all[static_cast<Eigen::Index>(i)] = fit.parameters[i].value;
  return all;
}

// All but the bias are searched on the axis, and the bias where that is at level 0.
LikelihoodFit maximize(const AnswersByLevel& answers, const LevelAxis& axis,
                       const std::vector<ParameterBounds>& bounds) {
  const std::vector<LevelAnswers> levels = levels_of(answers, axis);
  const Eigen::Matrix4d turn = turn_to(axis(0));
  std::vector<ParameterBounds> for_bias = bounds, for_others = bounds;
  for (std::size_t i = 0; i < bounds.size(); ++i)
    (i == bias ? for_others : for_bias)[i].with_interval = false;
  std::vector<std::vector<Parameters>> from = starts(answers, axis, bounds[lapse]);
  LikelihoodFit found, turned;
  for (int i = 0; i < 3; ++i) {
    found = maximize_turned(levels, Eigen::Matrix4d::Identity(), for_others, from);
    std::vector<std::vector<Parameters>> or_from = from;
    if (from.size() == 1) or_from.clear();  // one hill, and its top is known
    or_from.push_back({values(found)});
    turned = maximize_turned(levels, turn, for_bias, or_from);
    if (turned.log_likelihood <= found.log_likelihood + same_log_likelihood) break;
    from.push_back({turn.transpose() * values(turned)});
  }
  LikelihoodParameter& at_zero = found.parameters[bias] = turned.parameters[bias];
  const double length = std::hypot(1, axis(0));
  at_zero.value *= length;
  for (std::optional<double>* figure : {&at_zero.se, &at_zero.low, &at_zero.high})
    if (*figure) **figure *= length;
  return found;
}

// Of steps upwards or downwards, whichever are likelier.
double log_likelihood_of_steps(const AnswersByLevel& answers, const LikelihoodFit& fit) {
  const double astray = fit.parameters[lapse].value / 3;
  const std::array least{astray, astray, astray};
  AnswersByLevel mirrored;
  for (const auto& [level, n] : answers) mirrored[-level] = n;
  return std::max(heft::log_likelihood_of_steps(answers, least),
                  heft::log_likelihood_of_steps(mirrored, least));
}

FittedParameter parameter(const char* name, const LikelihoodParameter& fitted, double unit,
                          bool fixed) {
  const auto scaled = [unit](const std::optional<double>& value) {
    return value ? std::optional(*value / unit) : std::nullopt;
  };
  if (fixed) return {name, fitted.value, {}, {}, {}, true};
  FittedParameter result{name, std::nullopt, std::nullopt, scaled(fitted.low), scaled(fitted.high)};
  if (!fitted.exists) return result;
  result.value = fitted.value / unit;
  result.se = scaled(fitted.se);
  return result;
}

FittedParameter threshold(const FittedParameter& s) {
  FittedParameter result{"threshold_75_g", z_75 / *s.value};
  if (s.se) result.se = *result.value * *s.se / *s.value;
  result.low = s.high ? z_75 / *s.high : 0;
  result.high = z_75 / *s.low;
  return result;
}

std::vector<ParameterBounds> bounds_of(const FitOptions& options) {
  return {{-infinity, infinity, true, true},
          {0, infinity, true, true},
          {-infinity, infinity, true, true},
          {options.lapse.value_or(0), options.lapse.value_or(most_free_lapse)}};
}
}  // namespace

double refitted_indecision(const AnswersByLevel& answers, const FitOptions& options,
                           const Fit& near) {
  std::vector<ParameterBounds> bounds = bounds_of(options);
  for (ParameterBounds& one : bounds) one.with_interval = false;
  const auto value = [&](const char* name) { return near.parameter(name).value.value_or(0); };
  const LevelAxis axis(answers);
  const Parameters from(Eigen::Vector4d(value("sensitivity") * axis.unit_g, value("indecision"),
                                        value("bias") + value("sensitivity") * axis.mean_g,
                                        value("lapse")));
  const LikelihoodFit found =
      maximize_turned(levels_of(answers, axis), Eigen::Matrix4d::Identity(), bounds, {{from}});
  return std::max(found.log_likelihood, log_likelihood_of_steps(answers, found));
}

Fit fit_indecision(const AnswersByLevel& answers, const FitOptions& options) {
  Fit fit{{}, std::nullopt, trials_in(answers), answers.size(), too_little_chosen(answers)};
  const std::vector<ParameterBounds> bounds = bounds_of(options);
  LikelihoodFit found{std::vector<LikelihoodParameter>(indecision_names.size()), 0};
  for (auto& unknown : found.parameters) unknown.exists = false;
  found.parameters[lapse].value = bounds[lapse].low;
  double unit = 1;
  if (fit.n_trials > 0) {
    const LevelAxis axis(answers);
    unit = axis.unit_g;
    found = maximize(answers, axis, bounds);
    const double steps = log_likelihood_of_steps(answers, found);
    if (steps > found.log_likelihood - interval_drop)
      (found.parameters[sensitivity].value > 0 ? found.parameters[sensitivity].high
                                               : found.parameters[sensitivity].low) = std::nullopt;
    if (steps > found.log_likelihood - same_log_likelihood)
      for (const Unknown unknown : {sensitivity, indecision, bias})
        found.parameters[static_cast<std::size_t>(unknown)].exists = false;
    fit.log_likelihood = std::max(found.log_likelihood, steps);
  }
  for (std::size_t i = 0; i < indecision_names.size(); ++i)
    fit.parameters.push_back(parameter(indecision_names[i], found.parameters[i],
                                       i == sensitivity ? unit : 1, bounds[i].fixed()));
  const FittedParameter& s = fit.parameters[sensitivity];
  if (fit.why.empty()) fit.why = why_no_threshold({s.low, s.high}, reach_of(answers));
  fit.parameters.push_back(fit.identifiable() ? threshold(s) : FittedParameter{"threshold_75_g"});
  return fit;
}

namespace {
enum SameDifferent : std::size_t { same, different };

// Sensitivity and indecision at levels in units of the largest.
double log_likelihood_of_same(const AnswersByLevel& answers, double unit, double lapse,
                              const Parameters& at, Derivatives* derivatives) {
  double sum = 0;
  Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
  Eigen::Matrix2d hessian = Eigen::Matrix2d::Zero();
  for (const auto& [level, n] : answers) {
    const double x = level / unit, up = at[0] * x - at[1], down = -at[0] * x - at[1];
    const double above = (1 - lapse) * normal_density(up);
    const double below = (1 - lapse) * normal_density(down);
    const double p = lapse / 2 + (1 - lapse) * (normal_cdf(up) + normal_cdf(down));
    const LogShare yes = log_share(n[different], p), no = log_share(n[same], 1 - p);
    sum += yes.value + no.value;
    if (!derivatives) continue;
    const Eigen::Vector2d slope(x * (above - below), -above - below);
    const double own = -up * above - down * below, mixed = x * (up * above - down * below);
    const Eigen::Matrix2d second{{x * x * own, mixed}, {mixed, own}};
    gradient += (yes.slope - no.slope) * slope;
    hessian += (yes.slope - no.slope) * second;
    hessian += (yes.curvature + no.curvature) * slope * slope.transpose();
  }
  if (derivatives) *derivatives = {gradient, hessian};
  return sum;
}

// All levels with the same share of answers.
double log_likelihood_without_sensitivity(const AnswersByLevel& answers, double lapse) {
  const auto n = totals(answers);
  const double share = std::clamp(n[different] / trials_in(answers), lapse / 2, 1 - lapse / 2);
  return log_share(n[different], share).value + log_share(n[same], 1 - share).value;
}

LikelihoodFit maximize_same(const AnswersByLevel& answers, double unit, double lapse,
                            bool with_intervals, const std::vector<Parameters>& starts) {
  return maximize_likelihood(
      [&](const Parameters& at, Derivatives* derivatives) {
        return log_likelihood_of_same(answers, unit, lapse, at, derivatives);
      },
      {{0, infinity, with_intervals}, {0, infinity, with_intervals}}, {starts});
}
}  // namespace

double refitted_same_different(const AnswersByLevel& answers, const Fit& near) {
  const double unit = largest_level_of(answers);
  const double s = *near.parameters[0].value, tau = *near.parameters[1].value;
  const Parameters from(Eigen::Vector2d(s * unit, tau));
  return maximize_same(answers, unit, *near.parameters[2].value, false, {from}).log_likelihood;
}

Fit fit_same_different(const AnswersByLevel& answers, double lapse) {
  Fit fit{{{"sensitivity"}, {"indecision"}, {"lapse", lapse, {}, {}, {}, true}, {"threshold_75_g"}},
          std::nullopt,
          trials_in(answers),
          answers.size(),
          too_little(answers)};
  const double unit = largest_level_of(answers);
  if (!fit.why.empty() || unit == 0) return fit;
  std::vector<Parameters> starts;
  for (const double steep : {0.5, 2.0, 6.0, 20.0})
    for (const double wide : {0.3, 1.0, 3.0}) starts.emplace_back(Eigen::Vector2d(steep, wide));
  const LikelihoodFit found = maximize_same(answers, unit, lapse, true, starts);
  fit.log_likelihood = found.log_likelihood;
  for (std::size_t i = 0; i < 2; ++i)
    fit.parameters[i] =
        parameter(indecision_names[i], found.parameters[i], i == 0 ? unit : 1, false);
  FittedParameter& s = fit.parameters[0];
  // The likelihood is even in the sensitivity: at 0 it has no slope, and this decides.
  if (found.log_likelihood - log_likelihood_without_sensitivity(answers, lapse) < interval_drop)
    s.low = 0;
  fit.why = why_no_threshold({s.low, s.high}, reach_of(answers));
  if (fit.identifiable()) fit.parameters[3] = threshold(s);
  return fit;
}

}  // namespace heft
