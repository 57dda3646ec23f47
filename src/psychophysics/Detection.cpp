#include "psychophysics/Detection.h"

#include <cmath>

#include "psychophysics/Normal.h"

namespace heft {

namespace {
struct ZScore {
  double z = 0, variance = 0;  ///< of z
};

ZScore z_of(int n_yes, int n) {
  const double p = (n_yes + 0.5) / (n + 1.0);
  const double z = normal_quantile(p);
  return {z, p * (1 - p) / (n * normal_density(z) * normal_density(z))};
}
}  // namespace

std::optional<Detection> detection(const DetectionCounts& counts) {
  if (counts.n_signal == 0 || counts.n_noise == 0) return std::nullopt;
  const ZScore hits = z_of(counts.n_hits, counts.n_signal);
  const ZScore false_alarms = z_of(counts.n_false_alarms, counts.n_noise);
  const double se = std::sqrt(hits.variance + false_alarms.variance);
  return Detection{hits.z - false_alarms.z, se, -(hits.z + false_alarms.z) / 2, se / 2};
}

}  // namespace heft
