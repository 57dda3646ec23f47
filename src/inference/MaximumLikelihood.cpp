#include "inference/MaximumLikelihood.h"

#include <algorithm>
#include <cmath>

#include "inference/Likelihood.h"

namespace heft {

namespace {
// One side of a profile interval: steps outward from the estimate until the likelihood has fallen
// far enough, then finds the end between the last two steps.
class IntervalEnd {
 public:
  IntervalEnd(Likelihood& likelihood, const Maximum& best, Eigen::Index parameter, double direction)
      : likelihood_(likelihood), best_(best), parameter_(parameter), direction_(direction) {
    const ParameterBounds& bounds = likelihood.bounds(parameter);
    limit_ = direction < 0 ? bounds.low : bounds.high;
  }

  // @param first_step where the end may be
  void search(double first_step);

  std::optional<double> end() const { return end_; }
  // Whether the likelihood does not fall up to the parameter's bound.
  bool is_flat() const {
    return !end_ && last_.log_likelihood > best_.log_likelihood - same_log_likelihood;
  }
  // A point likelier than the estimate, if the search met one.
  const Maximum& likeliest() const { return likeliest_; }

 private:
  bool is_too_far(double to) const;
  // The root of the fall is nearly a straight line for any likelihood.
  double excess(const Maximum& there) const;
  // The end between two points, by regula falsi (Illinois variant).
  double between(Maximum inner, Maximum outer);

  Likelihood& likelihood_;
  const Maximum& best_;
  Eigen::Index parameter_;
  double direction_, limit_ = 0;
  Maximum last_ = best_, likeliest_ = best_;  // after best_
  std::optional<double> end_;
};

void IntervalEnd::search(double first_step) {
  constexpr int most_doublings = 14;
  const double center = best_.at[parameter_], beyond = std::abs(limit_ - center);
  // Steps double, but not beyond twice the last position, so that the other parameters can follow.
  double distance = std::min(first_step, (1 + std::abs(center)) / 2);
  Parameters change = likelihood_.tangent(best_.at, parameter_);
  for (int n_doublings = 0; n_doublings < most_doublings && !end_;) {
    double to = distance >= beyond ? limit_ : center + direction_ * distance;
    if (is_too_far(to)) {
      to = last_.at[parameter_] / 2;
    } else {
      distance *= 2;
      n_doublings += 1;
    }
    // Start of the other parameters: extrapolated from the last two points, or the last point
    // itself. An extrapolation may reach a bound where the likelihood is 0, without a way back.
    const Parameters ahead = last_.at + (to - last_.at[parameter_]) * change;
    const Maximum outer = likelier(likelihood_.profile(parameter_, to, ahead, last_.at),
                                   likelihood_.profile_from_anywhere(parameter_, to, last_.at));
    likeliest_ = likelier(likeliest_, outer);
    if (excess(outer) > 0)
      end_ = between(last_, outer);
    else if (to == limit_)
      end_ = limit_;
    if (to != last_.at[parameter_]) change = (outer.at - last_.at) / (to - last_.at[parameter_]);
    last_ = outer;
  }
}

// Steps from far away towards 0, where there may be several local maxima, are limited to half the
// distance.
bool IntervalEnd::is_too_far(double to) const {
  const double here = last_.at[parameter_];
  return !likelihood_.has_one_maximum() && direction_ * here < -1 &&
         std::abs(to - here) > std::abs(here) / 2;
}

double IntervalEnd::excess(const Maximum& there) const {
  const double fall = std::max(0.0, best_.log_likelihood - there.log_likelihood);
  return std::sqrt(fall) - std::sqrt(interval_drop);
}

double IntervalEnd::between(Maximum inner, Maximum outer) {
  double at_inner = excess(inner), at_outer = excess(outer);
  bool was_inner = false, was_outer = false;
  for (int i = 0; i < 60; ++i) {
    const double from = inner.at[parameter_], to = outer.at[parameter_];
    const double here = to - at_outer * (to - from) / (at_outer - at_inner);
    const double part = (here - from) / (to - from);
    Maximum middle = likelihood_.profile(parameter_, here, inner.at + part * (outer.at - inner.at));
    // If the two ends belong to different local maxima, the higher one may be reached from either.
    if (!likelihood_.has_one_maximum())
      middle = likelier(middle, likelihood_.profile(parameter_, here, inner.at, outer.at));
    else if (middle.log_likelihood < outer.log_likelihood)  // got stuck
      middle = likelier(middle, likelihood_.profile(parameter_, here, inner.at));
    const double at_middle = excess(middle);
    if (std::abs(at_middle) < 1e-6) return here;
    const bool is_inner = at_middle < 0;
    (is_inner ? inner : outer) = middle;
    (is_inner ? at_inner : at_outer) = at_middle;
    if (is_inner && was_inner) at_outer /= 2;
    if (!is_inner && was_outer) at_inner /= 2;
    was_inner = is_inner;
    was_outer = !is_inner;
  }
  return outer.at[parameter_];
}

// @return false if a likelier point than `best` was found, which then replaces it
bool fit_parameters(Likelihood& likelihood, Maximum& best,
                    std::vector<LikelihoodParameter>& parameters) {
  const Parameters errors = likelihood.standard_errors(best.at);
  parameters.assign(static_cast<std::size_t>(best.at.size()), {});
  for (Eigen::Index i = 0; i < best.at.size(); ++i) {
    LikelihoodParameter& parameter = parameters[static_cast<std::size_t>(i)];
    parameter.value = best.at[i];
    if (likelihood.bounds(i).fixed()) continue;
    parameter.exists = !std::isinf(errors[i]);
    if (errors[i] > 0 && parameter.exists) parameter.se = errors[i];
    if (!likelihood.bounds(i).with_interval) continue;
    for (const double direction : {-1.0, 1.0}) {
      IntervalEnd end(likelihood, best, i, direction);
      end.search(parameter.se ? 2 * *parameter.se : 0.1 * (1 + std::abs(best.at[i])));
      if (end.likeliest().log_likelihood > best.log_likelihood + same_log_likelihood) {
        best = end.likeliest();
        return false;
      }
      (direction < 0 ? parameter.low : parameter.high) = end.end();
      if (end.is_flat()) parameter.exists = false;
    }
  }
  return true;
}

void widen(LikelihoodParameter& parameter, const LikelihoodParameter& by) {
  if (parameter.low && (!by.low || *by.low < *parameter.low)) parameter.low = by.low;
  if (parameter.high && (!by.high || *by.high > *parameter.high)) parameter.high = by.high;
  parameter.exists = parameter.exists && by.exists;
}

// Widens intervals by those with a parameter held at its bound: values that are likely enough there
// are so with the parameter free, too. With several local maxima the search may miss them.
// @return as fit_parameters()
bool widen_by_held(const LogLikelihood& log_likelihood, const std::vector<ParameterBounds>& bounds,
                   const Starts& starts, Maximum& best,
                   std::vector<LikelihoodParameter>& parameters) {
  if (starts.size() == 1) return true;
  for (std::size_t held = 0; held < bounds.size(); ++held) {
    if (bounds[held].fixed() || parameters[held].value > bounds[held].low + 1e-9) continue;
    std::vector<ParameterBounds> fewer = bounds;
    fewer[held].high = fewer[held].low;
    Likelihood likelihood(log_likelihood, fewer, starts);
    Maximum at_bound = likelihood.climb(best.at);
    std::vector<LikelihoodParameter> by;
    if (!fit_parameters(likelihood, at_bound, by)) {
      best = at_bound;
      return false;
    }
    for (std::size_t i = 0; i < by.size(); ++i)
      if (i != held) widen(parameters[i], by[i]);
  }
  return true;
}
}  // namespace

LikelihoodFit maximize_likelihood(const LogLikelihood& log_likelihood,
                                  const std::vector<ParameterBounds>& bounds,
                                  const Starts& starts) {
  Likelihood likelihood(log_likelihood, bounds, starts);
  LikelihoodFit fit;
  Maximum best = likelihood.maximum();
  for (int i = 0; i < 10; ++i, best = likelihood.climb(best.at))
    if (fit_parameters(likelihood, best, fit.parameters) &&
        widen_by_held(log_likelihood, bounds, starts, best, fit.parameters))
      break;
  fit.log_likelihood = best.log_likelihood;
  return fit;
}

}  // namespace heft
