// Parameters at which data are most likely, with standard errors and profile intervals, for any
// model of at most seven parameters that knows its log likelihood and derivatives.
//
// Standard errors are from the observed information, without parameters at a bound. A profile
// interval contains the values v with 2 (max log L - max log L given v) <= the 95 % quantile of
// chi-square with 1 degree of freedom (Venzon & Moolgavkar 1988) that are connected to the
// estimate.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

namespace heft {

/// Half of that quantile: by how much the log likelihood is lower at an interval's end.
inline constexpr double interval_drop = 3.841458820694124 / 2;

/// Log likelihoods that differ by less than this count as equal.
inline constexpr double same_log_likelihood = 1e-6;

/// Values of the parameters, or a gradient; at most seven, so that no memory is allocated.
using Parameters = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 7, 1>;
using Curvature = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 7, 7>;

/// The first and second derivatives of a log likelihood.
struct Derivatives {
  Parameters gradient;
  Curvature hessian;
};

/// @param derivatives to be filled, of the right size; null: not asked for
using LogLikelihood = std::function<double(const Parameters& at, Derivatives* derivatives)>;

/// No bound.
inline constexpr double infinity = std::numeric_limits<double>::infinity();

struct ParameterBounds {
  double low = 0, high = 0;   ///< equal: the parameter is fixed; may be infinite
  bool with_interval = true;  ///< whether to compute a profile interval
  /// Where one of several such parameters is held at another value, starts are scaled by the same
  /// factor in the others.
  bool in_proportion = false;
  /// The longest step of climb_by_score(), beyond which the derivatives are inaccurate.
  double longest_step = infinity;
  bool fixed() const { return low == high; }
};

struct LikelihoodParameter {
  double value = 0;
  std::optional<double> se;         ///< none: fixed, at a bound, or no information
  std::optional<double> low, high;  ///< none: the interval has no end on that side
  /// False: the likelihood has no maximum, but grows without end towards infinity or is constant.
  bool exists = true;
};

struct LikelihoodFit {
  std::vector<LikelihoodParameter> parameters;
  double log_likelihood = 0;
};

/// By Newton's method within the bounds; where the likelihood is not finite, by NLopt's SLSQP.
/// @param starts within the bounds, in groups; the search continues from the likeliest of each. A
///   single group means that the likelihood has only one maximum
LikelihoodFit maximize_likelihood(const LogLikelihood& log_likelihood,
                                  const std::vector<ParameterBounds>& bounds,
                                  const std::vector<std::vector<Parameters>>& starts);

}  // namespace heft
