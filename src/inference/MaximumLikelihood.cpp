#include "inference/MaximumLikelihood.h"

#include <cmath>

#include "inference/IntervalEnd.h"
#include "inference/Likelihood.h"

namespace heft {

namespace {
// @return whether no value is likelier than the estimate; otherwise that is put in its place
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

// What is likely enough with a parameter held at its bound is so where it is free. Among several
// hills the search may miss that, as what leaves the bound doesn't always find back.
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
