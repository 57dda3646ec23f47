#include "inference/Likelihood.h"

#include <nlopt.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>

namespace heft {

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

// Whether no bound stops a step uphill along the parameter.
bool Likelihood::can_climb_along(Eigen::Index i, const Parameters& at) const {
  const double slope = derivatives_.gradient[i];
  return (at[i] > bounds(i).low || slope > 0) && (at[i] < bounds(i).high || slope < 0);
}

// Newton's step. Negative eigenvalues of the information are replaced by their absolute values, so
// that the step always leads uphill. Parameters that cannot move are left out of the equations and
// keep their exact values.
Parameters Likelihood::step_against(const Parameters& slope, const Parameters& at,
                                    Eigen::Index held) const {
  Parameters step = slope;
  Curvature curvature = -derivatives_.hessian;
  const auto moves = [&](Eigen::Index i) { return i != held && can_climb_along(i, at); };
  for (Eigen::Index i = 0; i < n_; ++i) {
    if (moves(i)) continue;
    step[i] = 0;
    curvature.row(i).setZero();
    curvature.col(i).setZero();
    curvature(i, i) = 1;
  }
  if (!curvature.allFinite()) return step;
  if (const Eigen::LLT<Curvature> factor(curvature); factor.info() == Eigen::Success) {
    factor.solveInPlace(step);
    return step;
  }
  const Eigen::SelfAdjointEigenSolver<Curvature> solver(curvature);
  const double largest = solver.eigenvalues().cwiseAbs().maxCoeff();
  Parameters along = solver.eigenvectors().transpose() * step;
  for (Eigen::Index i = 0; i < n_; ++i)
    along[i] /= std::max(std::abs(solver.eigenvalues()[i]), 1e-8 * largest);
  step = solver.eigenvectors() * along;
  for (Eigen::Index i = 0; i < n_; ++i)
    if (!moves(i)) step[i] = 0;  // the eigenvectors have rounding errors
  return step;
}

Parameters Likelihood::within_reach(Parameters step) const {
  double part = 1;
  for (Eigen::Index i = 0; i < n_; ++i)
    part = std::min(part, bounds(i).longest_step / std::abs(step[i]));
  return part < 1 ? Parameters(part * step) : step;
}

bool Likelihood::climb_by_newton(Maximum& best, Eigen::Index held) {
  best.log_likelihood = function_(best.at, &derivatives_);
  // Remaining gain in log likelihood, and with very many trials the rounding error of the sum.
  const double of_digits = std::abs(best.log_likelihood) * std::numeric_limits<double>::epsilon();
  const double good_enough = std::max(held < 0 ? 1e-13 : 1e-10, of_digits);
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
    if (!(there.log_likelihood > best.log_likelihood))
      return to_gain < std::max(1e-9, 500 * of_digits);  // no digits left
    best = there;
  }
  return false;
}

Maximum Likelihood::climb(Parameters from, Eigen::Index held) {
  Maximum best{within_bounds(std::move(from)), 0};
  return climb_by_newton(best, held) ? best : climb_by_nlopt(best, held);
}

Maximum Likelihood::climb_by_score(Parameters from, Eigen::Index held, Accuracy accuracy) {
  Maximum here{within_bounds(std::move(from)), 0};
  here.log_likelihood = function_(here.at, &derivatives_);
  double before = -infinity;
  for (int i = 0; i < 100; ++i) {
    if (i % 10 == 0 && here.log_likelihood < before + accuracy.rise) return here;
    if (i % 10 == 0) before = here.log_likelihood;
    const Parameters step = within_reach(step_against(derivatives_.gradient, here.at, held));
    if (!(step.dot(derivatives_.gradient) > accuracy.gain)) return here;
    const double low = here.log_likelihood - accuracy.value;
    // Whole steps may alternate without end.
    Maximum there = nothing();
    for (double length = i < 10 ? 1 : 0.5; length > 1e-3 && !(there.log_likelihood > low);
         length /= 2) {
      there.at = within_bounds(here.at + length * step);
      there.log_likelihood = function_(there.at, &derivatives_);
    }
    if (!(there.log_likelihood > low)) break;
    here = there;
  }
  return here;
}

// Sequential quadratic programming (Kraft 1994). It may stop early because of rounding, even at
// NaN; the result is the best point that it tried.
Maximum Likelihood::climb_by_nlopt(const Maximum& from, Eigen::Index held) {
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

Parameters Likelihood::in_proportion(Parameters start, Eigen::Index held, double held_value) const {
  if (!bounds(held).in_proportion || start[held] == 0) return start;
  const double growth = held_value / start[held];
  for (Eigen::Index i = 0; i < n_; ++i)
    if (bounds(i).in_proportion) start[i] *= growth;
  return start;
}

// Climbs from the three likeliest starts: the likeliest one may lead to a lower local maximum.
Maximum Likelihood::profile_from_anywhere(Eigen::Index held, double held_value,
                                          const Parameters& last) {
  if (has_one_maximum()) return nothing();
  Maximum best = profile(held, held_value, in_proportion(last, held, held_value));
  std::vector<Maximum> from;
  for (const std::vector<Parameters>& group : starts_)
    for (const Parameters& start : group) {
      Parameters at = in_proportion(start, held, held_value);
      at[held] = held_value;
      at = within_bounds(std::move(at));
      from.push_back({at, value(at)});
    }
  constexpr std::size_t most = 3;
  const auto end = from.begin() + static_cast<std::ptrdiff_t>(std::min(most, from.size()));
  std::ranges::partial_sort(from, end, std::greater(), &Maximum::log_likelihood);
  for (auto start = from.begin(); start != end; ++start)
    best = likelier(best, climb(start->at, held));
  return best;
}

// From the observed information. 0 if there is none.
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
  // A direction without information, such as a criterion with answers on one side of it only, makes
  // only the parameters in that direction unknown.
  const Eigen::ArrayXd open = (values.array() <= singular * values[n - 1]).cast<double>();
  const auto shares = solver.eigenvectors().array().square().matrix();
  const Parameters is_open = shares * open.matrix();
  const Parameters variances = shares * (open > 0).select(0, values.array().inverse()).matrix();
  for (Eigen::Index i = 0; i < n; ++i)
    errors[inside[static_cast<std::size_t>(i)]] = is_open[i] < singular
                                                      ? std::sqrt(variances[i]) * scale[i]
                                                      : std::numeric_limits<double>::infinity();
  return errors;
}

Parameters Likelihood::tangent(const Parameters& maximum, Eigen::Index along) {
  function_(maximum, &derivatives_);
  Parameters change = step_against(derivatives_.hessian.col(along), maximum, along);
  if (!change.allFinite()) change.setZero();
  change[along] = 1;
  return change;
}

}  // namespace heft
