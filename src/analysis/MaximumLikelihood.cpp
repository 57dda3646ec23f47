#include "analysis/MaximumLikelihood.h"

#include <nlopt.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

namespace heft {

namespace {
using Starts = std::vector<std::vector<Parameters>>;

struct Maximum {
  Parameters at;
  double log_likelihood = 0;
};

const Maximum& likelier(const Maximum& first, const Maximum& second) {
  return second.log_likelihood > first.log_likelihood ? second : first;
}

class Likelihood {
 public:
  Likelihood(const LogLikelihood& function, const std::vector<ParameterBounds>& bounds,
             const Starts& starts)
      : function_(function),
        bounds_(bounds),
        starts_(starts),
        n_(static_cast<Eigen::Index>(bounds.size())),
        derivatives_{Parameters(n_), Curvature(n_, n_)} {}

  double value(const Parameters& at) const { return function_(at, nullptr); }
  const ParameterBounds& bounds(Eigen::Index i) const {
    return bounds_[static_cast<std::size_t>(i)];
  }

  Maximum maximum();
  /// To the nearest maximum; one parameter may be held.
  Maximum climb(Parameters from, Eigen::Index held = -1);
  /// With one parameter held. @param from where to start for the others
  Maximum profile(Eigen::Index held, double held_value, Parameters from);
  /// The likelier of where two starts lead.
  Maximum profile(Eigen::Index held, double held_value, Parameters from, Parameters or_from);
  Maximum profile_from_anywhere(Eigen::Index held, double held_value);
  Parameters standard_errors(const Parameters& at);
  /// How the likeliest others move with one parameter, next to a maximum.
  Parameters tangent(const Parameters& maximum, Eigen::Index along);

 private:
  /// @return whether it got there
  bool climb_by_newton(Maximum& from, Eigen::Index held);
  Maximum climb_by_nlopt(Maximum from, Eigen::Index held);
  Parameters step_against(const Parameters& slope, const Parameters& at, Eigen::Index held) const;
  bool can_climb_along(Eigen::Index i, const Parameters& at) const;
  Parameters within_bounds(Parameters at) const;
  Maximum nothing() const { return {starts_[0][0], -std::numeric_limits<double>::infinity()}; }
  std::vector<Eigen::Index> free(Eigen::Index held) const;
  static double objective(unsigned n, const double* free_values, double* free_gradient, void* self);

  const LogLikelihood& function_;
  const std::vector<ParameterBounds>& bounds_;
  const Starts& starts_;
  Eigen::Index n_;
  Derivatives derivatives_;
  // What NLopt's search is at; its objective only sees what is free.
  Parameters at_;
  Maximum best_;
  std::vector<Eigen::Index> free_;
};

std::vector<Eigen::Index> Likelihood::free(Eigen::Index held) const {
  std::vector<Eigen::Index> all;
  for (Eigen::Index i = 0; i < n_; ++i)
    if (i != held && !bounds(i).fixed()) all.push_back(i);
  return all;
}

double Likelihood::objective(unsigned n, const double* free_values, double* free_gradient,
                             void* self) {
  auto& likelihood = *static_cast<Likelihood*>(self);
  for (unsigned k = 0; k < n; ++k) likelihood.at_[likelihood.free_[k]] = free_values[k];
  const double value = likelihood.function_(likelihood.at_, &likelihood.derivatives_);
  if (value > likelihood.best_.log_likelihood) likelihood.best_ = {likelihood.at_, value};
  for (unsigned k = 0; free_gradient != nullptr && k < n; ++k)
    free_gradient[k] = likelihood.derivatives_.gradient[likelihood.free_[k]];
  return value;
}

Parameters Likelihood::within_bounds(Parameters at) const {
  for (Eigen::Index i = 0; i < n_; ++i) at[i] = std::clamp(at[i], bounds(i).low, bounds(i).high);
  return at;
}

// Whether no bound stops a parameter.
bool Likelihood::can_climb_along(Eigen::Index i, const Parameters& at) const {
  const double slope = derivatives_.gradient[i];
  return (at[i] > bounds(i).low || slope > 0) && (at[i] < bounds(i).high || slope < 0);
}

// Newton's. Where the likelihood bends upwards it goes as far as if it bent down as much, so that
// it always leads uphill. What can't move is taken out of the equations.
Parameters Likelihood::step_against(const Parameters& slope, const Parameters& at,
                                    Eigen::Index held) const {
  Parameters step = slope;
  Curvature bend = -derivatives_.hessian;
  for (Eigen::Index i = 0; i < n_; ++i) {
    if (i != held && can_climb_along(i, at)) continue;
    step[i] = 0;
    bend.row(i).setZero();
    bend.col(i).setZero();
    bend(i, i) = 1;
  }
  if (!bend.allFinite()) return step;
  if (const Eigen::LLT<Curvature> factor(bend); factor.info() == Eigen::Success) {
    factor.solveInPlace(step);
    return step;
  }
  const Eigen::SelfAdjointEigenSolver<Curvature> solver(bend);
  const double largest = solver.eigenvalues().cwiseAbs().maxCoeff();
  Parameters along = solver.eigenvectors().transpose() * step;
  for (Eigen::Index i = 0; i < n_; ++i)
    along[i] /= std::max(std::abs(solver.eigenvalues()[i]), 1e-8 * largest);
  return solver.eigenvectors() * along;
}

bool Likelihood::climb_by_newton(Maximum& best, Eigen::Index held) {
  const double good_enough = held < 0 ? 1e-13 : 1e-10;  // what is still to be gained
  best.log_likelihood = function_(best.at, &derivatives_);
  for (int i = 0; i < 100; ++i) {
    const Parameters step = step_against(derivatives_.gradient, best.at, held);
    const double to_gain = step.dot(derivatives_.gradient);
    if (!std::isfinite(to_gain)) return false;
    if (to_gain <= good_enough) return true;
    Maximum there = nothing();
    for (double length = 1; length > 1e-9 && !(there.log_likelihood > best.log_likelihood);
         length /= 2) {
      there.at = within_bounds(best.at + length * step);
      there.log_likelihood = function_(there.at, &derivatives_);
    }
    if (!(there.log_likelihood > best.log_likelihood)) return to_gain < 1e-9;  // no digits left
    best = there;
  }
  return false;
}

Maximum Likelihood::climb(Parameters from, Eigen::Index held) {
  Maximum best{within_bounds(std::move(from)), 0};
  return climb_by_newton(best, held) ? best : climb_by_nlopt(best, held);
}

// Sequential quadratic programming (Kraft 1994). It may stop for lack of digits, even at no number:
// what counts is the best that it tried.
Maximum Likelihood::climb_by_nlopt(Maximum from, Eigen::Index held) {
  at_ = from.at;
  best_ = from;
  free_ = free(held);
  if (free_.empty()) return best_;
  std::vector<double> values, low, high;
  for (const Eigen::Index i : free_) {
    values.push_back(at_[i]);
    low.push_back(bounds(i).low);
    high.push_back(bounds(i).high);
  }
  const std::unique_ptr<nlopt_opt_s, void (*)(nlopt_opt)> search(
      nlopt_create(NLOPT_LD_SLSQP, static_cast<unsigned>(free_.size())), nlopt_destroy);
  nlopt_set_lower_bounds(search.get(), low.data());
  nlopt_set_upper_bounds(search.get(), high.data());
  nlopt_set_max_objective(search.get(), objective, this);
  nlopt_set_ftol_abs(search.get(), 1e-12);
  nlopt_set_maxeval(search.get(), 500);
  double reached = 0;
  nlopt_optimize(search.get(), values.data(), &reached);
  return best_;
}

Maximum Likelihood::maximum() {
  Maximum best = nothing();
  for (const std::vector<Parameters>& group : starts_) {
    Maximum start = nothing();
    for (const Parameters& at : group) start = likelier(start, {at, value(at)});
    best = likelier(best, climb(start.at));
  }
  return best;
}

Maximum Likelihood::profile(Eigen::Index held, double held_value, Parameters from) {
  from[held] = held_value;
  return climb(std::move(from), held);
}

Maximum Likelihood::profile(Eigen::Index held, double held_value, Parameters from,
                            Parameters or_from) {
  const Maximum first = profile(held, held_value, std::move(from));
  return likelier(first, profile(held, held_value, std::move(or_from)));
}

Maximum Likelihood::profile_from_anywhere(Eigen::Index held, double held_value) {
  Maximum best = nothing();
  if (starts_.size() == 1) return best;  // one hill, and that is known
  for (const std::vector<Parameters>& group : starts_)
    for (Parameters start : group) {
      start[held] = held_value;
      start = within_bounds(std::move(start));
      best = likelier(best, {start, value(start)});
    }
  return climb(best.at, held);
}

// From the observed information. 0 where there is none.
constexpr double singular = 1e-7;  // of its eigenvalues, where each parameter has the same scale

Parameters Likelihood::standard_errors(const Parameters& at) {
  std::vector<Eigen::Index> inside;
  for (const Eigen::Index i : free(-1)) {
    const double at_bound = 1e-5 * std::max(1.0, std::abs(at[i]));
    if (at[i] - at_bound >= bounds(i).low && at[i] + at_bound <= bounds(i).high)
      inside.push_back(i);
  }
  const auto n = static_cast<Eigen::Index>(inside.size());
  function_(at, &derivatives_);
  const Curvature information = -derivatives_.hessian(inside, inside);
  Parameters errors = Parameters::Zero(at.size());
  if (n == 0 || !information.allFinite() || !(information.diagonal().minCoeff() > 0)) return errors;
  const Parameters scale = information.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<Curvature> solver(scale.asDiagonal() * information *
                                                        scale.asDiagonal());
  const Parameters& values = solver.eigenvalues();
  if (!(values[0] > singular * values[n - 1])) return errors;
  const Curvature inverse = solver.eigenvectors() * values.cwiseInverse().asDiagonal() *
                            solver.eigenvectors().transpose();
  errors(inside) = inverse.diagonal().cwiseSqrt().cwiseProduct(scale);
  return errors;
}

Parameters Likelihood::tangent(const Parameters& maximum, Eigen::Index along) {
  function_(maximum, &derivatives_);
  Parameters change = step_against(derivatives_.hessian.col(along), maximum, along);
  if (!change.allFinite()) change.setZero();
  change[along] = 1;
  return change;
}

/// One side of a profile interval: walks out from the estimate until the likelihood has fallen far
/// enough, and back to where it just has.
class IntervalEnd {
 public:
  IntervalEnd(Likelihood& likelihood, const Maximum& best, Eigen::Index parameter, double direction)
      : likelihood_(likelihood), best_(best), parameter_(parameter), direction_(direction) {
    const ParameterBounds& bounds = likelihood.bounds(parameter);
    limit_ = direction < 0 ? bounds.low : bounds.high;
  }

  /// @param first_step where the end may be
  void search(double first_step) {
    constexpr int most_doublings = 14;
    const double center = best_.at[parameter_], beyond = std::abs(limit_ - center);
    // Doubled each time, and never beyond twice the last place: the others have to follow.
    double distance = std::min(first_step, (1 + std::abs(center)) / 2);
    Parameters change = likelihood_.tangent(best_.at, parameter_);
    for (int i = 0; i < most_doublings && !end_; ++i, distance *= 2) {
      const double to = distance >= beyond ? limit_ : center + direction_ * distance;
      // Where the others go on as they went, or stay: going on may lead to a bound where nothing is
      // likely, and from where no way leads back.
      const Parameters ahead = last_.at + (to - last_.at[parameter_]) * change;
      const Maximum outer = likelier(likelihood_.profile(parameter_, to, ahead, last_.at),
                                     likelihood_.profile_from_anywhere(parameter_, to));
      likeliest_ = likelier(likeliest_, outer);
      if (excess(outer) > 0)
        end_ = between(last_, outer);
      else if (to == limit_)
        end_ = limit_;
      if (to != last_.at[parameter_]) change = (outer.at - last_.at) / (to - last_.at[parameter_]);
      last_ = outer;
    }
  }

  std::optional<double> end() const { return end_; }
  /// Whether all the way to infinity nothing was lost.
  bool is_flat() const {
    return !end_ && last_.log_likelihood > best_.log_likelihood - same_log_likelihood;
  }
  /// Better than the estimate, if that was met on the way.
  const Maximum& likeliest() const { return likeliest_; }

 private:
  // The root of the fall is nearly a straight line for any likelihood.
  double excess(const Maximum& there) const {
    const double fall = std::max(0.0, best_.log_likelihood - there.log_likelihood);
    return std::sqrt(fall) - std::sqrt(interval_drop);
  }

  // Where the fall is just enough, by regula falsi (its Illinois variant).
  double between(Maximum inner, Maximum outer) {
    double at_inner = excess(inner), at_outer = excess(outer);
    bool was_inner = false, was_outer = false;
    for (int i = 0; i < 60; ++i) {
      const double from = inner.at[parameter_], to = outer.at[parameter_];
      const double here = to - at_outer * (to - from) / (at_outer - at_inner);
      const double part = (here - from) / (to - from);
      Maximum middle =
          likelihood_.profile(parameter_, here, inner.at + part * (outer.at - inner.at));
      if (middle.log_likelihood < outer.log_likelihood)  // got stuck
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

  Likelihood& likelihood_;
  const Maximum& best_;
  Eigen::Index parameter_;
  double direction_, limit_ = 0;
  Maximum last_ = best_, likeliest_ = best_;  // after best_
  std::optional<double> end_;
};

// @return whether no value is likelier than the estimate; otherwise that is put in its place
bool fit_parameters(Likelihood& likelihood, Maximum& best,
                    std::vector<LikelihoodParameter>& parameters) {
  const Parameters errors = likelihood.standard_errors(best.at);
  parameters.assign(static_cast<std::size_t>(best.at.size()), {});
  for (Eigen::Index i = 0; i < best.at.size(); ++i) {
    LikelihoodParameter& parameter = parameters[static_cast<std::size_t>(i)];
    parameter.value = best.at[i];
    if (likelihood.bounds(i).fixed()) continue;
    if (errors[i] > 0) parameter.se = errors[i];
    if (!likelihood.bounds(i).with_interval) continue;
    for (const double direction : {-1.0, 1.0}) {
      IntervalEnd end(likelihood, best, i, direction);
      end.search(errors[i] > 0 ? 2 * errors[i] : 0.1 * (1 + std::abs(best.at[i])));
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
