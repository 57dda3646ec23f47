// Quantiles of measured values.
#pragma once

#include <optional>
#include <vector>

namespace heft {

/// Quantile by linear interpolation between order statistics (Hyndman and Fan's type 7, the default
/// of R and NumPy); none for no values. fraction in [0, 1].
std::optional<double> quantile(std::vector<double> values, double fraction);

}  // namespace heft
