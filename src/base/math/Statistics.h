// Quantiles of measured values, and shrinkage of estimates.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace heft {

/// Quantile by linear interpolation between order statistics (Hyndman and Fan's type 7, the default
/// of R and NumPy); none for no values. fraction in [0, 1].
std::optional<double> quantile(std::vector<double> values, double fraction);

struct QuartilesOf {
  double lower = 0, median = 0, upper = 0;
};

/// The quantiles of .25, .5 and .75, of values that are copied and sorted once; none for no values.
std::optional<QuartilesOf> quartiles(std::vector<double> values);

/// How much of an estimate is to be believed where it is usually nothing: what exceeds a standard
/// deviation, the more the further it does (empirical Bayes: the positive-part estimator of James &
/// Stein, 1961). @param in_sds the estimate, in its standard deviations
inline double believed_fraction(double in_sds) {
  const double size = std::max(1.0, std::abs(in_sds));
  return 1 - 1 / (size * size);
}

}  // namespace heft
