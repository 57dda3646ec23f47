#include "psychophysics/Normal.h"

#include <cmath>
#include <numbers>

namespace heft {

double normal_density(double z) {
  return std::exp(-z * z / 2) / std::sqrt(2 * std::numbers::pi);
}

double normal_cdf(double z) {
  return std::erfc(-z / std::numbers::sqrt2) / 2;
}

// Halley's iteration: a handful of steps from any start nearby.
double normal_quantile(double p) {
  if (p > 0.5) return -normal_quantile(1 - p);
  const double tail = std::sqrt(-2 * std::log(p));
  double z = -(tail - (2.30753 + 0.27061 * tail) / (1 + tail * (0.99229 + 0.04481 * tail)));
  for (int i = 0; i < 4; ++i) {
    const double step = (normal_cdf(z) - p) / normal_density(z);
    z -= step / (1 + z * step / 2);
  }
  return z;
}

}  // namespace heft
