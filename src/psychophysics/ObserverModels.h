// Observer models: psychometric functions, the indecision model, signal detection, and the standard
// normal distribution. Pure functions; arguments outside the stated ranges are not checked.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "base/Names.h"

namespace heft {

enum class PsychometricShape { cumulative_normal, logistic, weibull, gumbel };
template <>
struct EnumNames<PsychometricShape> {
  static constexpr std::array<std::string_view, 4> names{"cumulative_normal", "logistic", "weibull",
                                                         "gumbel"};
};

/// Unit of levels: linear, decimal logarithm, or decibels (20 a decade).
enum class LevelScale { linear, log10, db };
template <>
struct EnumNames<LevelScale> {
  static constexpr std::array<std::string_view, 3> names{"linear", "log10", "db"};
};

/// F(u) of a shape at threshold 0 and steepness 1, 1 - F(u) without cancellation, F'(u) and F''(u).
/// The Weibull and Gumbel shapes have the same F: 1 - exp(-e^u).
struct StandardCurve {
  double below = 0, above = 0, density = 0, density_slope = 0;
};
StandardCurve standard_curve(PsychometricShape shape, double u);

/// p(x) = guess + (1 - guess - lapse) F(steepness * (place(x) - place(threshold))).
/// `slope` is the spread s of F((x - t) / s), above 0. For the Weibull function it is the exponent
/// beta (Watson 1979; with scales: Watson 2017): 1 - exp(-(x/t)^beta), with 10^(beta (x - t)) for
/// log10 levels and 10^(beta (x - t) / 20) for dB.
struct PsychometricFunction {
  PsychometricShape shape = PsychometricShape::cumulative_normal;
  /// Changes the Weibull formula only; the other shapes use levels as they are.
  LevelScale scale = LevelScale::linear;

  /// Whether levels and threshold must be above 0.
  bool takes_logarithm() const;
  /// The abscissa of a level on which threshold and slope only shift and scale the curve.
  double place(double level) const;
  double level(double place) const;
  double steepness(double slope) const;
  double slope(double steepness) const;
};

struct PsychometricParameters {
  double threshold = 0, slope = 1, guess = 0, lapse = 0;
};

/// Probability of a positive response at a level.
double probability(const PsychometricFunction& function, const PsychometricParameters& parameters,
                   double level);

/// Indecision model, or 2-AC (Christensen, Lee & Brockhoff 2012; Garcia-Perez & Alcala-Quintana
/// 2017): the decision variable is D = sensitivity * level + bias + N(0, 1); the response is
/// "comparison" if D > indecision, "reference" if D < -indecision, otherwise "none". A lapse is one
/// of the three at random.
struct IndecisionParameters {
  double sensitivity = 0;  ///< per unit of level
  double indecision = 0;   ///< criterion half-width tau, at least 0
  double bias = 0, lapse = 0;
};

/// Probabilities of the three responses; their sum is 1.
struct IndecisionShares {
  double reference = 0, none = 0, comparison = 0;
};
/// @param level comparison minus reference
IndecisionShares indecision_shares(const IndecisionParameters& parameters, double level);

/// Trials with a difference (signal) and without (noise), and "different" responses in each. Draws
/// of a model may exceed the range of int.
struct DetectionCounts {
  double n_signal = 0, n_hits = 0;
  double n_noise = 0, n_false_alarms = 0;
};

/// Equal-variance signal detection (Macmillan & Creelman 2005). Standard errors by Gourevitch &
/// Galanter (1967), from the corrected rates.
struct Detection {
  double d_prime = 0, d_prime_se = 0;
  double criterion = 0, criterion_se = 0;  ///< positive: biased to "no difference"
};

/// Uses log-linear rates, (x + 1/2) / (n + 1), which are never 0 or 1 (Hautus 1995).
/// @return none without signal trials or without noise trials
std::optional<Detection> detection(const DetectionCounts& counts);

/// Density of N(0, 1).
double normal_density(double z);

/// Accurate in both tails.
double normal_cdf(double z);

/// Inverse of normal_cdf. @param p in (0, 1)
double normal_quantile(double p);

}  // namespace heft
