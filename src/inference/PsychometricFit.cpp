#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>

#include "inference/Fit.h"
#include "inference/MaximumLikelihood.h"
#include "inference/checks/GoodnessOfFit.h"

namespace heft {

namespace {
enum Answer : std::size_t { negative, positive };
enum Unknown : Eigen::Index { place, steepness, guess, lapse };
constexpr std::array<const char*, 4> psychometric_names{"threshold", "slope", "guess", "lapse"};

constexpr double most_free = 0.5;      // of guess and lapse
constexpr double furthest_place = 25;  // ranges of the levels
constexpr double reach = 1.5;          // a threshold's interval: from the middle, in ranges

ParameterBounds share_bounds(const std::optional<double>& share, double other) {
  if (share) return {*share, *share};
  return {0, std::min(most_free, 1 - other)};
}

/// The answers on an axis where the levels reach from -1/2 to 1/2.
class Levels {
 public:
  Levels(const AnswersByLevel& answers, const PsychometricFunction& function) {
    double low = infinity, high = -infinity;
    for (const auto& [level, n] : answers) {
      places_.push_back(function.place(level));
      n_.push_back({n[negative], n[positive]});
      if (!std::isfinite(places_.back())) continue;  // Weibull's x = 0
      low = std::min(low, places_.back());
      high = std::max(high, places_.back());
    }
    if (low > high) low = high = 0;
    middle_ = low / 2 + high / 2;
    if (high > low) range_ = high - low;
    for (double& place : places_) place = to_axis(place);
  }

  /// Neighboring levels merged at their mean, until there are at most `most`.
  Levels coarser(std::size_t most) const {
    Levels few = *this;
    few.places_.clear();
    few.n_.clear();
    const std::size_t step = (size() + most - 1) / most;
    for (std::size_t i = 0; i < size(); i += step) {
      double sum = 0, n = 0;
      std::array<double, 2> answers{};
      for (std::size_t k = i; k < std::min(i + step, size()); ++k) {
        const double n_here = n_[k][negative] + n_[k][positive];
        sum += n_here * places_[k];
        n += n_here;
        for (const Answer answer : {negative, positive}) answers[answer] += n_[k][answer];
      }
      few.places_.push_back(sum / n);
      few.n_.push_back(answers);
    }
    return few;
  }

  std::size_t size() const { return n_.size(); }
  double place(std::size_t i) const { return places_[i]; }
  const std::array<double, 2>& n(std::size_t i) const { return n_[i]; }
  double range() const { return range_; }
  double to_axis(double place) const { return (place - middle_) / range_; }
  double from_axis(double place) const { return middle_ + range_ * place; }

 private:
  std::vector<double> places_;
  std::vector<std::array<double, 2>> n_;
  double middle_ = 0, range_ = 1;
};

// How the share of positive answers at one level changes with the parameters.
struct ShareSlopes {
  Eigen::Vector4d first;
  Eigen::Matrix4d second = Eigen::Matrix4d::Zero();  // the lower half
};

ShareSlopes share_slopes(const StandardCurve& curve, double distance, const Parameters& at) {
  const double between = 1 - at[guess] - at[lapse];
  ShareSlopes slopes;
  slopes.first << 0, 0, curve.above, -curve.below;
  if (curve.density == 0) return slopes;                 // far away, or at no finite place
  const Eigen::Vector2d by_u(-at[steepness], distance);  // of place and steepness
  slopes.first.head<2>() = between * curve.density * by_u;
  slopes.second.topLeftCorner<2, 2>() = between * curve.density_slope * by_u * by_u.transpose();
  slopes.second(steepness, place) -= between * curve.density;
  for (const Unknown share : {guess, lapse})
    slopes.second.row(share).head<2>() = -curve.density * by_u.transpose();
  return slopes;
}

double log_likelihood(const Levels& levels, PsychometricShape shape, const Parameters& at,
                      Derivatives* derivatives) {
  const double between = 1 - at[guess] - at[lapse];
  double sum = 0;
  Eigen::Vector4d gradient = Eigen::Vector4d::Zero();
  Eigen::Matrix4d hessian = Eigen::Matrix4d::Zero();
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const double distance = levels.place(i) - at[place];
    const StandardCurve curve = standard_curve(shape, at[steepness] * distance);
    const LogShare yes = log_share(levels.n(i)[positive], at[guess] + between * curve.below);
    const LogShare no = log_share(levels.n(i)[negative], at[lapse] + between * curve.above);
    sum += yes.value + no.value;
    if (!derivatives) continue;
    const ShareSlopes slopes = share_slopes(curve, distance, at);
    gradient += (yes.slope - no.slope) * slopes.first;
    hessian += (yes.curvature + no.curvature) * slopes.first * slopes.first.transpose() +
               (yes.slope - no.slope) * slopes.second;
  }
  if (derivatives)
    *derivatives = {gradient, hessian.selfadjointView<Eigen::Lower>().toDenseMatrix()};
  return sum;
}

// All levels with the same share of positive answers.
double log_likelihood_of_flat(const AnswersByLevel& answers,
                              const std::vector<ParameterBounds>& bounds) {
  const auto n = totals(answers);
  const double share = std::clamp(n[positive] / (n[negative] + n[positive]), bounds[guess].low,
                                  1 - bounds[lapse].low);
  return log_share(n[positive], share).value + log_share(n[negative], 1 - share).value;
}

double log_likelihood_of_step(AnswersByLevel answers, const PsychometricFunction& function,
                              const LikelihoodFit& fit) {
  const double guesses = fit.parameters[guess].value, lapses = fit.parameters[lapse].value;
  double sum = 0;
  if (const auto zero = answers.find(0); function.takes_logarithm() && zero != answers.end()) {
    sum = log_share(zero->second[positive], guesses).value +
          log_share(zero->second[negative], 1 - guesses).value;
    answers.erase(zero);  // below any step
  }
  return sum + log_likelihood_of_steps(answers, std::array{lapses, guesses});
}

std::vector<double> starting_places(const Levels& levels) {
  std::vector<double> finite;
  for (std::size_t i = 0; i < levels.size(); ++i)
    if (std::isfinite(levels.place(i))) finite.push_back(levels.place(i));
  std::vector<double> places{-1, -0.5, 0, 0.5, 1};
  const std::size_t step = 1 + finite.size() / 16;
  for (std::size_t i = step; i < finite.size(); i += step)
    places.push_back((finite[i - 1] + finite[i]) / 2);
  return places;
}

std::vector<std::vector<Parameters>> starts(const Levels& levels,
                                            const std::vector<ParameterBounds>& bounds) {
  const auto shares = [](const ParameterBounds& share) {
    if (share.fixed()) return std::vector<double>{share.low};
    return std::vector<double>{0.04 * share.high, 0.4 * share.high, 0.9 * share.high};
  };
  std::vector<std::vector<Parameters>> all;
  for (const double at_place : starting_places(levels)) {
    all.emplace_back();
    for (const double at_steepness : {1.0, 3.0, 8.0, 20.0, 60.0, 400.0})
      for (const double at_guess : shares(bounds[guess]))
        for (const double at_lapse : shares(bounds[lapse]))
          all.back().emplace_back(Eigen::Vector4d(at_place, at_steepness, at_guess, at_lapse));
  }
  return all;
}

LikelihoodFit maximize(const Levels& levels, PsychometricShape shape,
                       const std::vector<ParameterBounds>& bounds,
                       const std::vector<std::vector<Parameters>>& from) {
  return maximize_likelihood(
      [&](const Parameters& at, Derivatives* derivatives) {
        return log_likelihood(levels, shape, at, derivatives);
      },
      bounds, from);
}

// With very many levels, local maxima are compared on merged levels, because the time of each start
// grows with their number; with so many answers, one search from the best is enough.
LikelihoodFit maximize(const Levels& levels, PsychometricShape shape,
                       const std::vector<ParameterBounds>& bounds) {
  constexpr std::size_t many = 5000, few = 500;
  if (levels.size() <= many) return maximize(levels, shape, bounds, starts(levels, bounds));
  const Levels coarse = levels.coarser(few);
  const LikelihoodFit near = maximize(coarse, shape, bounds, starts(coarse, bounds));
  Parameters from(static_cast<Eigen::Index>(near.parameters.size()));
  for (Eigen::Index i = 0; i < from.size(); ++i)
    from[i] = near.parameters[static_cast<std::size_t>(i)].value;
  return maximize(levels, shape, bounds, {{from}});
}

// Whether there are answers of probability 0: positive ones at level 0 without guessing.
bool impossible(const AnswersByLevel& answers, const FitOptions& options) {
  const auto zero = answers.find(0);
  return options.function.takes_logarithm() && options.guess == 0.0 && zero != answers.end() &&
         zero->second[positive] > 0;
}

// Likelihood ratio test against a constant probability, which has one parameter.
std::string no_slope(double gained, const std::vector<ParameterBounds>& bounds) {
  const auto n_free = std::ranges::count(bounds, false, &ParameterBounds::fixed);
  const boost::math::chi_squared chance(static_cast<double>(n_free - 1));
  if (2 * gained > quantile(chance, 0.95)) return "";
  return "no reliable slope: a constant response rate fits within 95 %";
}

std::string no_end(const LikelihoodFit& fit, double step) {
  const LikelihoodParameter& at = fit.parameters[place];
  if (step > fit.log_likelihood - same_log_likelihood)
    return "separation: a step at or between levels fits as well as any slope; show levels in "
           "between";
  if (std::abs(at.value) > reach) return "the threshold is far outside the levels shown";
  if (!at.low || !at.high || *at.low < -reach || *at.high > reach)
    return "the threshold's 95 % interval reaches beyond the levels shown by more than their range";
  if (!at.se || *at.se > *at.high - *at.low)  // usual is a quarter
    return "flat likelihood: many pairs of threshold and slope fit equally well";
  return "";
}

FittedParameter threshold(const LikelihoodParameter& fitted, const Levels& levels,
                          const PsychometricFunction& function) {
  const auto level = [&](double at) { return function.level(levels.from_axis(at)); };
  FittedParameter parameter{psychometric_names[place], level(fitted.value)};
  const double stretch = function.takes_logarithm() ? *parameter.value : 1;
  if (fitted.se) parameter.se = *fitted.se * levels.range() * stretch;
  parameter.low = level(*fitted.low);
  parameter.high = level(*fitted.high);
  return parameter;
}

FittedParameter slope(const LikelihoodParameter& fitted, const Levels& levels,
                      const PsychometricFunction& function) {
  const auto slope_at = [&](double at) { return function.slope(at / levels.range()); };
  FittedParameter parameter{psychometric_names[steepness], slope_at(fitted.value)};
  if (fitted.se) parameter.se = *fitted.se / fitted.value * *parameter.value;
  parameter.low = fitted.low ? std::optional(slope_at(*fitted.low)) : std::nullopt;
  parameter.high = fitted.high ? std::optional(slope_at(*fitted.high)) : std::nullopt;
  if (function.shape == PsychometricShape::weibull) return parameter;
  std::swap(parameter.low, parameter.high);  // a spread is the inverse of steepness
  if (!parameter.low) parameter.low = 0;
  return parameter;
}

FittedParameter share(Unknown unknown, const LikelihoodFit& fit) {
  const LikelihoodParameter& fitted = fit.parameters[static_cast<std::size_t>(unknown)];
  return {psychometric_names[static_cast<std::size_t>(unknown)], fitted.value, fitted.se,
          fitted.low, fitted.high};
}

std::vector<FittedParameter> unknown_parameters(const std::vector<ParameterBounds>& bounds) {
  std::vector<FittedParameter> parameters;
  for (std::size_t i = 0; i < psychometric_names.size(); ++i) {
    parameters.push_back({psychometric_names[i]});
    parameters.back().fixed = bounds[i].fixed();
    if (bounds[i].fixed()) parameters.back().value = bounds[i].low;
  }
  return parameters;
}

std::vector<ParameterBounds> bounds_of(const FitOptions& options) {
  return {{-furthest_place, furthest_place},
          {0, infinity},
          share_bounds(options.guess, options.lapse.value_or(0)),
          share_bounds(options.lapse, options.guess.value_or(0))};
}
}  // namespace

Fit fit_psychometric(const AnswersByLevel& answers, const FitOptions& options) {
  const std::vector<ParameterBounds> bounds = bounds_of(options);
  Fit fit{unknown_parameters(bounds), std::nullopt, trials_in(answers), answers.size(),
          too_little(answers)};
  if (fit.n_trials == 0) return fit;
  if (impossible(answers, options)) {
    fit.why = "there are positive answers at 0, which the function can't give without guesses";
    return fit;
  }
  const Levels levels(answers, options.function);
  LikelihoodFit found = maximize(levels, options.function.shape, bounds);
  const double flat = log_likelihood_of_flat(answers, bounds);
  const double step = log_likelihood_of_step(answers, options.function, found);
  if (step > found.log_likelihood - interval_drop) found.parameters[steepness].high = std::nullopt;
  fit.log_likelihood = std::max({found.log_likelihood, flat, step});
  if (fit.why.empty()) fit.why = no_slope(*fit.log_likelihood - flat, bounds);
  if (fit.why.empty()) fit.why = no_end(found, step);
  if (!fit.identifiable()) return fit;
  fit.parameters[place] = threshold(found.parameters[place], levels, options.function);
  fit.parameters[steepness] = slope(found.parameters[steepness], levels, options.function);
  for (const Unknown unknown : {guess, lapse})
    if (!bounds[static_cast<std::size_t>(unknown)].fixed())
      fit.parameters[static_cast<std::size_t>(unknown)] = share(unknown, found);
  return fit;
}

double refitted_psychometric(const AnswersByLevel& answers, const FitOptions& options,
                             const Fit& near) {
  std::vector<ParameterBounds> bounds = bounds_of(options);
  for (ParameterBounds& one : bounds) one.with_interval = false;
  const Levels levels(answers, options.function);
  const PsychometricFunction& function = options.function;
  const Parameters from(
      Eigen::Vector4d(levels.to_axis(function.place(*near.parameter("threshold").value)),
                      function.steepness(*near.parameter("slope").value) * levels.range(),
                      *near.parameter("guess").value, *near.parameter("lapse").value));
  const LikelihoodFit found = maximize(levels, function.shape, bounds, {{from}});
  return std::max({found.log_likelihood, log_likelihood_of_flat(answers, bounds),
                   log_likelihood_of_step(answers, function, found)});
}

namespace {
bool has_both_signs(const AnswersByLevel& answers) {
  return answers.begin()->first < 0;
}
}  // namespace

FitOptions forced_choice_options(const AnswersByLevel& answers) {
  return {.guess = has_both_signs(answers) ? fixed_lapse : 0.5, .lapse = fixed_lapse};
}

ForcedChoiceFit fit_forced_choice(const AnswersByLevel& answers) {
  const Fit fit = fit_psychometric(answers, forced_choice_options(answers));
  if (!has_both_signs(answers)) return {fit.parameter("threshold"), {}, fit.why};
  FittedParameter threshold = fit.parameter("slope");
  for (auto* figure : {&threshold.value, &threshold.low, &threshold.high})
    if (*figure) **figure *= z_75;
  return {threshold, fit.parameter("threshold"), fit.why};
}

}  // namespace heft
