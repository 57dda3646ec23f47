#include "inference/PopulationLikelihood.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/Parallel.h"
#include "inference/Statistics.h"

namespace heft {

namespace {
// Fewer take less time than a thread does to start.
constexpr std::size_t people_at_once = 32;

// Error of the log likelihood where some people chose a cube and others never did.
constexpr double of_choices_of_few = 0.5;

Parameters within(Parameters at, const std::vector<ParameterBounds>& bounds) {
  for (Eigen::Index i = 0; i < at.size(); ++i) {
    const ParameterBounds& limit = bounds[static_cast<std::size_t>(i)];
    at[i] = std::clamp(at[i], limit.low, limit.high);
  }
  return at;
}
}  // namespace

PopulationLikelihood::PopulationLikelihood(const std::vector<std::vector<LevelAnswers>>& people)
    : bounds_(n_population_parameters) {
  const auto bound = [this](std::size_t i, double low, double high, double longest_step) {
    bounds_[i] = {.low = low, .high = high, .longest_step = longest_step};
  };
  bound(mean_log_sensitivity, -9, 6, 1);
  bound(mean_log_criterion, -7, 9, 1);  // beyond all levels at any sensitivity
  bound(log_sd_sensitivity, std::log(0.05), std::log(2), 0.7);
  bound(log_sd_criterion, std::log(0.05), std::log(2), 0.7);
  bound(log_sd_bias, std::log(0.05), std::log(2), 0.7);
  bound(arctanh_correlation, -1.5, 1.5, 0.5);
  bound(shared_lapse, 0, most_lapses, 0.05);
  for (const std::vector<LevelAnswers>& answers : people) {
    people_.emplace_back(answers);
    for (const auto& [level, n] : answers) {
      const double n_here = n[0] + n[1] + n[2];
      n_trials_ += n_here;
      n_none_ += n[none_answer];
      mean_square_level_ += n_here * level * level;
    }
  }
  mean_square_level_ /= n_trials_;
}

// A start whose criterion gives the observed share of "no difference".
Parameters PopulationLikelihood::start(double log_sensitivity) const {
  const double s = std::exp(log_sensitivity);
  const double none = std::clamp(n_none_ / n_trials_, 0.02, 0.98);
  const double tau = std::sqrt(1 + s * s * mean_square_level_) * normal_quantile((1 + none) / 2);
  Parameters at(n_population_parameters);
  at << log_sensitivity, std::log(tau), std::log(0.4), std::log(0.4), 0, std::log(0.3), 0.02;
  return at;
}

// Added up in the order of people, so that the sum does not depend on the number of processors.
double PopulationLikelihood::value(const Parameters& at, Derivatives* derivatives) {
  std::vector<double> values(people_.size());
  std::vector<Derivatives> terms(derivatives ? people_.size() : 0);
  in_parallel(people_.size(), people_at_once, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      people_[i].center(at);
      values[i] = people_[i].log_likelihood(at, derivatives ? &terms[i] : nullptr);
    }
  });
  if (derivatives) {
    derivatives->gradient.setZero(n_population_parameters);
    derivatives->hessian.setZero(n_population_parameters, n_population_parameters);
  }
  // The weak prior on the correlation.
  const double rho = std::tanh(at[arctanh_correlation]);
  double sum = std::log1p(-rho * rho);
  if (derivatives) {
    derivatives->gradient[arctanh_correlation] = -2 * rho;
    derivatives->hessian(arctanh_correlation, arctanh_correlation) = -2 * (1 - rho * rho);
  }
  for (const double value : values) sum += value;
  for (const Derivatives& term : terms) {
    derivatives->gradient += term.gradient;
    derivatives->hessian += term.hessian;
  }
  return sum;
}

LogLikelihood PopulationLikelihood::log_likelihood() {
  return [this](const Parameters& at, Derivatives* derivatives) { return value(at, derivatives); };
}

Maximum PopulationLikelihood::climb(Parameters from, Eigen::Index held) {
  const LogLikelihood function = log_likelihood();
  const Starts starts{{from}};
  return Likelihood(function, bounds_, starts)
      .climb_by_score(from, held, {held < 0 ? 1e-7 : 1e-5, of_choices_of_few, of_quadrature()});
}

// From the likeliest start with a small and with a large spread of sensitivities: both may be local
// maxima if there are few people and some of them guess.
Maximum PopulationLikelihood::maximum(std::optional<double> lapse) {
  const Eigen::Index held = lapse ? Eigen::Index{shared_lapse} : -1;
  Maximum best{start(0), -infinity};
  for (const double spread : {0.4, 1.5}) {
    Maximum likeliest{start(0), -infinity};
    for (const double log_sensitivity : {-0.5, 0.5, 1.5, 2.5, 3.5}) {
      Parameters at = start(log_sensitivity);
      at[log_sd_sensitivity] = std::log(spread);
      at[shared_lapse] = lapse.value_or(at[shared_lapse]);
      likeliest = likelier(likeliest, {at, value(at, nullptr)});
    }
    best = likelier(best, climb(likeliest.at, held));
  }
  return best;
}

namespace {
constexpr double straight_enough = 0.01;  // of the root of the fall

double interval_drop_of(std::size_t n_people) {
  const double n = static_cast<double>(n_people);
  if (n < 2) return interval_drop;
  const double t = student_t_quantile(n - 1);
  return n / 2 * std::log1p(t * t / (n - 1));
}

// One end of a profile interval. The square root of the fall is nearly a straight line.
class ProfileEnd {
 public:
  ProfileEnd(PopulationLikelihood& people, const Maximum& best, Eigen::Index of, double drop)
      : people_(people), best_(best), of_(of), root_(std::sqrt(drop)) {}

  // @param first_step signed; @param change of the others with this parameter
  std::optional<double> search(double first_step, Parameters change);
  // A point likelier than the estimate, if the search met one.
  const Maximum& likeliest() const { return likeliest_; }

 private:
  Maximum held_at(double to, Parameters from) {
    from[of_] = to;
    const Maximum found = people_.climb(within(std::move(from), people_.bounds()), of_);
    likeliest_ = likelier(likeliest_, found);
    return found;
  }
  double excess(const Maximum& at) const {
    return std::sqrt(std::max(0.0, best_.log_likelihood - at.log_likelihood)) - root_;
  }
  double between(Maximum inner, Maximum outer);
  Maximum at_extreme_sensitivity(double limit);

  PopulationLikelihood& people_;
  const Maximum& best_;
  Maximum likeliest_ = best_;
  Eigen::Index of_;
  double root_;
};

std::optional<double> ProfileEnd::search(double step, Parameters change) {
  const ParameterBounds& bounds = people_.bounds()[static_cast<std::size_t>(of_)];
  const double limit = step < 0 ? bounds.low : bounds.high;
  int n_steps = 0;
  for (Maximum inner = best_; inner.at[of_] != limit;) {
    if (++n_steps == 3 && of_ == mean_log_sensitivity && excess(at_extreme_sensitivity(limit)) <= 0)
      return std::nullopt;
    const double here = inner.at[of_];
    const double to = std::abs(limit - here) <= std::abs(step) ? limit : here + step;
    const Maximum outer = held_at(to, inner.at + (to - here) * change);
    if (excess(outer) > 0) return between(inner, outer);
    const double by_line = (to - best_.at[of_]) * -excess(outer) / (excess(outer) + root_);
    if (-excess(outer) < straight_enough && to != limit) return to + by_line;
    // A little beyond where the straight line ends.
    step = std::copysign(std::min(1.1 * std::abs(by_line), 1.5 * std::abs(step)), step);
    change = (outer.at - inner.at) / (to - here);
    inner = outer;
  }
  return std::nullopt;
}

// The fit at the extreme sensitivity, which saves further steps if the interval does not end.
// Criteria in units of levels stay the same; answers that they do not explain are lapses.
Maximum ProfileEnd::at_extreme_sensitivity(double limit) {
  Parameters change = Parameters::Zero(n_population_parameters);
  if (limit > 0) change[mean_log_criterion] = limit - best_.at[mean_log_sensitivity];
  change[shared_lapse] = 0.02;
  return held_at(limit, best_.at + change);
}

// Regula falsi until the straight line is as good as the profile.
double ProfileEnd::between(Maximum inner, Maximum outer) {
  const double narrow = people_.bounds()[static_cast<std::size_t>(of_)].longest_step / 1000;
  for (int i = 0;; ++i) {
    const double at_inner = excess(inner), at_outer = excess(outer);
    const double part = -at_inner / (at_outer - at_inner);
    const double here = inner.at[of_] + part * (outer.at[of_] - inner.at[of_]);
    const bool is_narrow = std::abs(outer.at[of_] - inner.at[of_]) < narrow;
    if (std::min(-at_inner, at_outer) < straight_enough || is_narrow || i == 30) return here;
    const Maximum middle = held_at(here, inner.at + part * (outer.at - inner.at));
    (excess(middle) < 0 ? inner : outer) = middle;
  }
}
}  // namespace

PopulationLikelihood::ProfileInterval PopulationLikelihood::interval(Maximum& best,
                                                                     Eigen::Index of) {
  const double drop = interval_drop_of(people_.size());
  for (int i = 0;; ++i) {
    const LogLikelihood function = log_likelihood();
    const Starts starts{{best.at}};
    Likelihood likelihood(function, bounds_, starts);
    const double se = likelihood.standard_errors(best.at)[of];
    const double step = se > 0 && se < 1 ? se * std::sqrt(2 * drop) : 0.3;
    const Parameters change = likelihood.tangent(best.at, of);
    ProfileEnd low(*this, best, of, drop), high(*this, best, of, drop);
    const ProfileInterval found{low.search(-step, change), high.search(step, change)};
    const Maximum likeliest = likelier(low.likeliest(), high.likeliest());
    const double likelier_than = best.log_likelihood + of_quadrature();
    if (i == 5 || likeliest.log_likelihood <= likelier_than) return found;
    const Maximum there = climb(likeliest.at);
    if (there.log_likelihood <= likelier_than) return found;  // it leads back to the estimate
    best = there;
  }
}

bool PopulationLikelihood::excludes_no_sensitivity(const Maximum& best) {
  Parameters at = best.at;
  at[mean_log_sensitivity] = bounds_[mean_log_sensitivity].low;
  const double without = climb(std::move(at), mean_log_sensitivity).log_likelihood;
  return best.log_likelihood - without > interval_drop_of(people_.size());
}

std::vector<double> PopulationLikelihood::influences(const Maximum& best, Eigen::Index of) {
  Derivatives sum;
  value(best.at, &sum);
  std::vector<Eigen::Index> free;
  for (Eigen::Index i = 0; i < n_population_parameters; ++i) {
    const ParameterBounds& bounds = bounds_[static_cast<std::size_t>(i)];
    if (i == of || (best.at[i] > bounds.low + 1e-6 && best.at[i] < bounds.high - 1e-6))
      free.push_back(i);
  }
  const Curvature information = -sum.hessian(free, free);
  const auto place = std::ranges::find(free, of) - free.begin();
  const Parameters row =
      information.ldlt().solve(Parameters::Unit(static_cast<Eigen::Index>(free.size()), place));
  std::vector<double> all;
  for (const PersonIntegral& person : people_) all.push_back(row.dot(person.score()(free)));
  return all;
}

}  // namespace heft
