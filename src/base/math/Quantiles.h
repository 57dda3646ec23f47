// Quantiles and a shrinkage factor.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace heft {

/// Quantile by linear interpolation between order statistics (Hyndman and Fan's type 7, the default
/// of R and NumPy); none without values. fraction in [0, 1].
std::optional<double> quantile(std::vector<double> values, double fraction);

struct QuartilesOf {
  double lower = 0, median = 0, upper = 0;
};

/// The quantiles 0.25, 0.5 and 0.75; none without values. Sorts once.
std::optional<QuartilesOf> quartiles(std::vector<double> values);

/// Factor that shrinks an estimate of an effect that is usually absent: 0 within one standard
/// error, 1 - 1/z^2 beyond (positive-part estimator of James and Stein, 1961).
/// @param in_sds z, the estimate divided by its standard error
inline double shrinkage_factor(double in_sds) {
  const double size = std::max(1.0, std::abs(in_sds));
  return 1 - 1 / (size * size);
}

}  // namespace heft
