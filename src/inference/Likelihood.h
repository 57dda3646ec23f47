// Local and global maxima of a log likelihood, with one parameter held or none. Used by
// MaximumLikelihood.cpp for estimates and intervals.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <utility>
#include <vector>

#include "inference/MaximumLikelihood.h"

namespace heft {

using Starts = std::vector<std::vector<Parameters>>;

struct Maximum {
  Parameters at;
  double log_likelihood = 0;
};

inline const Maximum& likelier(const Maximum& first, const Maximum& second) {
  return second.log_likelihood > first.log_likelihood ? second : first;
}

struct Accuracy {
  double gain = 0;   ///< a maximum is where Newton's method expects no larger gain
  double value = 0;  ///< error of values at different points
  double rise = 0;   ///< ten steps that raise the value by less are in vain
};

/// A log likelihood within bounds, and the searches for its maximum. Constructor arguments must
/// outlive it.
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

  /// Whether one group of starts is enough to find the maximum.
  bool has_one_maximum() const { return starts_.size() == 1; }
  Maximum maximum();
  /// The local maximum reached from a point. @param held index of a fixed parameter; -1: none
  Maximum climb(Parameters from, Eigen::Index held = -1);
  /// The same if values at different points are inexact: follows the derivatives instead.
  Maximum climb_by_score(Parameters from, Eigen::Index held, Accuracy accuracy);
  /// The maximum with one parameter held. @param from start of the others
  Maximum profile(Eigen::Index held, double held_value, Parameters from);
  /// The better of the maxima from two starts.
  Maximum profile(Eigen::Index held, double held_value, Parameters from, Parameters or_from);
  /// The best from all starts, and from the last maximum with its parameters scaled in proportion.
  Maximum profile_from_anywhere(Eigen::Index held, double held_value, const Parameters& last);
  /// 0: at a bound, or unknown; infinite: the answers leave it open.
  Parameters standard_errors(const Parameters& at);
  /// Derivatives of the other parameters' profile estimates by one parameter, at a maximum.
  Parameters tangent(const Parameters& maximum, Eigen::Index along);

 private:
  /// @return whether it converged
  bool climb_by_newton(Maximum& from, Eigen::Index held);
  Maximum climb_by_nlopt(const Maximum& from, Eigen::Index held);
  Parameters step_against(const Parameters& slope, const Parameters& at, Eigen::Index held) const;
  Parameters within_reach(Parameters step) const;
  bool can_climb_along(Eigen::Index i, const Parameters& at) const;
  Parameters within_bounds(Parameters at) const;
  Parameters in_proportion(Parameters start, Eigen::Index held, double held_value) const;
  Maximum nothing() const { return {starts_[0][0], -std::numeric_limits<double>::infinity()}; }
  std::vector<Eigen::Index> free(Eigen::Index held) const;
  static double objective(unsigned n, const double* free_values, double* free_gradient, void* self);

  const LogLikelihood& function_;
  const std::vector<ParameterBounds>& bounds_;
  const Starts& starts_;
  Eigen::Index n_;
  Derivatives derivatives_;
  // The point of NLopt's search, whose objective only has the free parameters.
  Parameters at_;
  Maximum best_;
  std::vector<Eigen::Index> free_;
};

}  // namespace heft
