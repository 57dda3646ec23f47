// Quantiles of measured values.
#pragma once

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

}  // namespace heft
