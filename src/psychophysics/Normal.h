// The standard normal distribution.
#pragma once

namespace heft {

double normal_density(double z);

/// Its tails stay exact.
double normal_cdf(double z);

/// @param p in (0, 1)
double normal_quantile(double p);

}  // namespace heft
