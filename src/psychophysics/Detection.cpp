#include "psychophysics/Detection.h"

#include <cmath>
#include <numbers>

namespace heft {

namespace {
double density(double z) {
  return std::exp(-z * z / 2) / std::sqrt(2 * std::numbers::pi);
}

struct ZScore {
  double z = 0, variance = 0;  ///< of z
};

ZScore z_of(int n_yes, int n) {
  const double p = (n_yes + 0.5) / (n + 1.0);
  const double z = normal_quantile(p);
  return {z, p * (1 - p) / (n * density(z) * density(z))};
}
}  // namespace

// Halley's iteration on erfc, whose tails stay exact: a handful of steps from any start nearby.
double normal_quantile(double p) {
  if (p > 0.5) return -normal_quantile(1 - p);
  const double tail = std::sqrt(-2 * std::log(p));
  double z = -(tail - (2.30753 + 0.27061 * tail) / (1 + tail * (0.99229 + 0.04481 * tail)));
  for (int i = 0; i < 4; ++i) {
    const double step = (std::erfc(-z / std::numbers::sqrt2) / 2 - p) / density(z);
    z -= step / (1 + z * step / 2);
  }
  return z;
}

std::optional<Detection> detection(const DetectionCounts& counts) {
  if (counts.n_signal == 0 || counts.n_noise == 0) return std::nullopt;
  const ZScore hits = z_of(counts.n_hits, counts.n_signal);
  const ZScore false_alarms = z_of(counts.n_false_alarms, counts.n_noise);
  const double se = std::sqrt(hits.variance + false_alarms.variance);
  return Detection{hits.z - false_alarms.z, se, -(hits.z + false_alarms.z) / 2, se / 2};
}

}  // namespace heft
