#include "analysis/MaximumLikelihood.h"

#include <nlopt.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

namespace heft {

namespace {
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Starts = std::vector<std::vector<VectorXd>>;

struct Maximum {
  VectorXd at;
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
        gradient_(static_cast<Eigen::Index>(bounds.size())) {}

  double value(const VectorXd& at) { return function_(at, gradient_); }
  const ParameterBounds& bounds(Eigen::Index i) const {
    return bounds_[static_cast<std::size_t>(i)];
  }

  Maximum maximum();
  /// To the nearest maximum; one parameter may be held.
  Maximum climb(VectorXd from, Eigen::Index held = -1);
  /// With one parameter held. @param from where to start for the others
  Maximum profile(Eigen::Index held, double held_value, VectorXd from);
  Maximum profile_from_anywhere(Eigen::Index held, double held_value);
  VectorXd standard_errors(const VectorXd& at);

 private:
  Maximum nothing() const { return {starts_[0][0], -std::numeric_limits<double>::infinity()}; }
  std::vector<Eigen::Index> free(Eigen::Index held) const;
  static double objective(unsigned n, const double* free_values, double* free_gradient, void* self);

  const LogLikelihood& function_;
  const std::vector<ParameterBounds>& bounds_;
  const Starts& starts_;
  // What the search is at; NLopt's objective only sees what is free.
  VectorXd gradient_, at_;
  Maximum best_;
  std::vector<Eigen::Index> free_;
};

std::vector<Eigen::Index> Likelihood::free(Eigen::Index held) const {
  std::vector<Eigen::Index> all;
  for (Eigen::Index i = 0; i < gradient_.size(); ++i)
    if (i != held && !bounds(i).fixed()) all.push_back(i);
  return all;
}

double Likelihood::objective(unsigned n, const double* free_values, double* free_gradient,
                             void* self) {
  auto& likelihood = *static_cast<Likelihood*>(self);
  for (unsigned k = 0; k < n; ++k) likelihood.at_[likelihood.free_[k]] = free_values[k];
  const double value = likelihood.value(likelihood.at_);
  if (value > likelihood.best_.log_likelihood) likelihood.best_ = {likelihood.at_, value};
  for (unsigned k = 0; free_gradient != nullptr && k < n; ++k)
    free_gradient[k] = likelihood.gradient_[likelihood.free_[k]];
  return value;
}

// Sequential quadratic programming (Kraft 1994) by NLopt. It may stop for lack of digits, even at
// no number: what counts is the best that it tried.
Maximum Likelihood::climb(VectorXd from, Eigen::Index held) {
  at_ = std::move(from);
  free_ = free(held);
  std::vector<double> values, low, high;
  for (const Eigen::Index i : free_) {
    at_[i] = std::clamp(at_[i], bounds(i).low, bounds(i).high);
    values.push_back(at_[i]);
    low.push_back(bounds(i).low);
    high.push_back(bounds(i).high);
  }
  best_ = {at_, value(at_)};
  if (free_.empty()) return best_;
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
  for (const std::vector<VectorXd>& group : starts_) {
    Maximum start = nothing();
    for (const VectorXd& at : group) start = likelier(start, {at, value(at)});
    best = likelier(best, climb(start.at));
  }
  return best;
}

Maximum Likelihood::profile(Eigen::Index held, double held_value, VectorXd from) {
  from[held] = held_value;
  return climb(std::move(from), held);
}

Maximum Likelihood::profile_from_anywhere(Eigen::Index held, double held_value) {
  Maximum best = nothing();
  if (starts_.size() == 1) return best;  // one hill, and that is known
  for (const std::vector<VectorXd>& group : starts_)
    for (VectorXd start : group) {
      start[held] = held_value;
      best = likelier(best, {start, value(start)});
    }
  return climb(best.at, held);
}

// The information by central differences of the gradient. 0 where there is none.
constexpr double singular = 1e-7;  // of its eigenvalues, where each parameter has the same scale

VectorXd Likelihood::standard_errors(const VectorXd& at) {
  std::vector<Eigen::Index> inside;
  std::vector<double> steps;
  for (const Eigen::Index i : free(-1)) {
    const double step = 1e-5 * std::max(1.0, std::abs(at[i]));
    if (at[i] - step < bounds(i).low || at[i] + step > bounds(i).high) continue;
    inside.push_back(i);
    steps.push_back(step);
  }
  const auto n = static_cast<Eigen::Index>(inside.size());
  MatrixXd information(n, n);
  for (Eigen::Index j = 0; j < n; ++j) {
    const auto column = static_cast<std::size_t>(j);
    VectorXd change = VectorXd::Zero(n), there = at;
    for (const double side : {-1.0, 1.0}) {
      there[inside[column]] = at[inside[column]] + side * steps[column];
      value(there);
      change -= side * gradient_(inside);
    }
    information.col(j) = change / (2 * steps[column]);
  }
  VectorXd errors = VectorXd::Zero(at.size());
  if (n == 0 || !(information.diagonal().minCoeff() > 0)) return errors;
  const VectorXd scale = information.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(scale.asDiagonal() * information *
                                                       scale.asDiagonal());
  const VectorXd& values = solver.eigenvalues();
  if (!(values[0] > singular * values[n - 1])) return errors;
  const MatrixXd inverse = solver.eigenvectors() * values.cwiseInverse().asDiagonal() *
                           solver.eigenvectors().transpose();
  errors(inside) = inverse.diagonal().cwiseSqrt().cwiseProduct(scale);
  return errors;
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
    Maximum before = best_;
    for (int i = 0; i < most_doublings && !end_; ++i, distance *= 2) {
      const double to = distance >= beyond ? limit_ : center + direction_ * distance;
      // Where the others go on as they went.
      const double went = last_.at[parameter_] - before.at[parameter_];
      const double share = went == 0 ? 0 : (to - last_.at[parameter_]) / went;
      const VectorXd ahead = last_.at + share * (last_.at - before.at);
      const Maximum outer = likelier(likelihood_.profile(parameter_, to, ahead),
                                     likelihood_.profile_from_anywhere(parameter_, to));
      likeliest_ = likelier(likeliest_, outer);
      if (excess(outer) > 0)
        end_ = between(last_, outer);
      else if (to == limit_)
        end_ = limit_;
      before = std::exchange(last_, outer);
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
      const Maximum middle =
          likelihood_.profile(parameter_, here, inner.at + part * (outer.at - inner.at));
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
  const VectorXd errors = likelihood.standard_errors(best.at);
  parameters.assign(static_cast<std::size_t>(best.at.size()), {});
  for (Eigen::Index i = 0; i < best.at.size(); ++i) {
    LikelihoodParameter& parameter = parameters[static_cast<std::size_t>(i)];
    parameter.value = best.at[i];
    if (likelihood.bounds(i).fixed()) continue;
    if (errors[i] > 0) parameter.se = errors[i];
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
}  // namespace

LikelihoodFit maximize_likelihood(const LogLikelihood& log_likelihood,
                                  const std::vector<ParameterBounds>& bounds,
                                  const Starts& starts) {
  Likelihood likelihood(log_likelihood, bounds, starts);
  LikelihoodFit fit;
  Maximum best = likelihood.maximum();
  for (int i = 0; i < 10 && !fit_parameters(likelihood, best, fit.parameters); ++i)
    best = likelihood.climb(best.at);
  fit.log_likelihood = best.log_likelihood;
  return fit;
}

}  // namespace heft
