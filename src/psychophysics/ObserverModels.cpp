#include "psychophysics/ObserverModels.h"

#include <cmath>
#include <numbers>

namespace heft {

double normal_density(double z) {
  return std::exp(-z * z / 2) / std::sqrt(2 * std::numbers::pi);
}

double normal_cdf(double z) {
  return std::erfc(-z / std::numbers::sqrt2) / 2;
}

// Halley's iteration from the rational start of Abramowitz & Stegun (26.2.22).
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

namespace {
// Converts the Weibull exponent to natural logarithms.
double exponent_factor(LevelScale scale) {
  if (scale == LevelScale::linear) return 1;
  return scale == LevelScale::log10 ? std::numbers::ln10 : std::numbers::ln10 / 20;
}

StandardCurve logistic_curve(double u) {
  const double below = 1 / (1 + std::exp(-u)), above = 1 / (1 + std::exp(u));
  return {below, above, below * above, below * above * (above - below)};
}

StandardCurve gumbel_curve(double u) {
  const double hazard = std::exp(u), above = std::exp(-hazard);
  const double density = above > 0 ? hazard * above : 0;
  return {-std::expm1(-hazard), above, density, density > 0 ? density * (1 - hazard) : 0};
}

// Phi(to) - Phi(from), from <= to, without cancellation near 1.
double normal_between(double from, double to) {
  return from > 0 ? normal_cdf(-from) - normal_cdf(-to) : normal_cdf(to) - normal_cdf(from);
}
}  // namespace

StandardCurve standard_curve(PsychometricShape shape, double u) {
  switch (shape) {
    case PsychometricShape::cumulative_normal: {
      const double density = normal_density(u);
      return {normal_cdf(u), normal_cdf(-u), density, density > 0 ? -u * density : 0};
    }
    case PsychometricShape::logistic:
      return logistic_curve(u);
    case PsychometricShape::weibull:
    case PsychometricShape::gumbel:
      break;
  }
  return gumbel_curve(u);
}

bool PsychometricFunction::takes_logarithm() const {
  return shape == PsychometricShape::weibull && scale == LevelScale::linear;
}

double PsychometricFunction::place(double level) const {
  return takes_logarithm() ? std::log(level) : level;
}

double PsychometricFunction::level(double place) const {
  return takes_logarithm() ? std::exp(place) : place;
}

double PsychometricFunction::steepness(double slope) const {
  return shape == PsychometricShape::weibull ? slope * exponent_factor(scale) : 1 / slope;
}

double PsychometricFunction::slope(double steepness) const {
  return shape == PsychometricShape::weibull ? steepness / exponent_factor(scale) : 1 / steepness;
}

double probability(const PsychometricFunction& function, const PsychometricParameters& parameters,
                   double level) {
  const auto& [threshold, slope, guess, lapse] = parameters;
  const double u = function.steepness(slope) * (function.place(level) - function.place(threshold));
  return guess + (1 - guess - lapse) * standard_curve(function.shape, u).below;
}

IndecisionShares indecision_shares(const IndecisionParameters& parameters, double level) {
  const double mean = parameters.sensitivity * level + parameters.bias;
  const double up = mean - parameters.indecision, down = -mean - parameters.indecision;
  const double attentive = 1 - parameters.lapse, lapsed = parameters.lapse / 3;
  const double reference = normal_cdf(down), comparison = normal_cdf(up);
  double none = 1 - reference - comparison;
  if (none < 1e-4) none = normal_between(down, -up);  // avoids cancellation
  return {lapsed + attentive * reference, lapsed + attentive * none,
          lapsed + attentive * comparison};
}

namespace {
struct ZScore {
  double z = 0, variance = 0;  ///< of z
};

ZScore z_of(double n_yes, double n) {
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
