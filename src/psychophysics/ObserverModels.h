// Formulas of how answers depend on the level: psychometric functions, the indecision model, signal
// detection, and the standard normal distribution that they use.
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

/// What a level is a number of: plain units, their decimal logarithm, or decibels (20 a decade).
enum class LevelScale { linear, log10, db };
template <>
struct EnumNames<LevelScale> {
  static constexpr std::array<std::string_view, 3> names{"linear", "log10", "db"};
};

/// F(u) of a shape at threshold 0 and steepness 1, 1 - F(u) without cancellation, F'(u) and F''(u).
/// Weibull's and Gumbel's are the same: 1 - exp(-e^u).
struct StandardCurve {
  double below = 0, above = 0, density = 0, density_slope = 0;
};
StandardCurve standard_curve(PsychometricShape shape, double u);

/// p(x) = guess + (1 - guess - lapse) F(steepness * (place(x) - place(threshold))).
/// `slope` is the spread s of F((x - t) / s), for Weibull's function the exponent beta of Watson
/// (1979; with scales: Watson 2017): 1 - exp(-(x/t)^beta), on log10 levels with 10^(beta (x - t)),
/// on dB with 10^(beta (x - t) / 20).
struct PsychometricFunction {
  PsychometricShape shape = PsychometricShape::cumulative_normal;
  /// Changes Weibull's formula alone; the others take levels as they are.
  LevelScale scale = LevelScale::linear;

  /// Whether levels (and the threshold) can't be below 0.
  bool takes_logarithm() const;
  /// Where a level lies on the axis on which only place and steepness of the curve change.
  double place(double level) const;
  double level(double place) const;
  double steepness(double slope) const;
  double slope(double steepness) const;
};

struct PsychometricParameters {
  double threshold = 0, slope = 1, guess = 0, lapse = 0;
};

/// Of a positive answer.
double probability(const PsychometricFunction& function, const PsychometricParameters& parameters,
                   double level);

/// The 2-AC model (Christensen, Lee & Brockhoff 2011; Garcia-Perez & Alcala-Quintana 2017): what is
/// felt is D = sensitivity * level + bias + N(0, 1); the answer is "comparison" where D >
/// indecision, "reference" where D < -indecision, otherwise "none". A lapse is any of them.
struct IndecisionParameters {
  double sensitivity = 0;  ///< per unit of level
  double indecision = 0;   ///< half the width between the criteria, at least 0
  double bias = 0, lapse = 0;
};

struct IndecisionShares {
  double reference = 0, none = 0, comparison = 0;
};
IndecisionShares indecision_shares(const IndecisionParameters& parameters, double level);

/// Trials with a difference (signal) and without (noise), and in how many a difference was told.
struct DetectionCounts {
  int n_signal = 0, n_hits = 0;
  int n_noise = 0, n_false_alarms = 0;
};

/// Standard errors: Gourevitch & Galanter (1967), from the corrected rates.
struct Detection {
  double d_prime = 0, d_prime_se = 0;
  double criterion = 0, criterion_se = 0;  ///< positive: inclined to say "no difference"
};

/// With log-linear rates, (x + 1/2) / (n + 1), which are never 0 or 1 (Hautus 1995).
/// @return none where there is no trial of either kind
std::optional<Detection> detection(const DetectionCounts& counts);

double normal_density(double z);

/// Its tails stay exact.
double normal_cdf(double z);

/// @param p in (0, 1)
double normal_quantile(double p);

}  // namespace heft
