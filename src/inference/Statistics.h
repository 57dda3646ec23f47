// Means, spreads and intervals of plain numbers. Where a figure does not exist (the SD of one
// value) there is none; no function returns NaN or infinity for finite input.
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace heft {

/// The confidence of every interval that the analysis gives.
inline constexpr double confidence_level = 0.95;

struct Interval {
  double low = 0, high = 0;
};

/// With fewer people (except a single one, whose own fit is used) there is no interval.
inline constexpr int least_people = 5;

/// A difference or slope over several people's figures.
struct Contrast {
  double value = 0, standard_error = 0;
  int n = 0;                                                      ///< people
  Interval interval(double confidence = confidence_level) const;  ///< Student's t, n - 1 df
  /// The smallest true value that 80 % of such studies would find (95 % interval excludes 0).
  double smallest_effect() const;
};

/// None for no values.
std::optional<double> mean(std::span<const double> values);

/// Standard deviation over n-1; none for fewer than two values, exactly 0 where all are equal.
std::optional<double> sample_sd(std::span<const double> values);

/// The slope of the least-squares line of y on x is the sum of these weights times y. At least two
/// different x.
std::vector<double> slope_weights(std::span<const double> x);

/// Of the least-squares line of y on x. At least two different x.
double slope(std::span<const double> x, std::span<const double> y);

/// mean ± t(n-1) * SD / sqrt(n); none for fewer than two values.
std::optional<Interval> student_t_interval(std::span<const double> values);

/// The same from figures that were published instead of values. n >= 2.
Interval student_t_interval(double mean, double sd, int n);

/// How many standard errors an interval reaches to each side. df > 0.
double student_t_quantile(double degrees_of_freedom, double confidence = confidence_level);

/// Clopper and Pearson (1934): the exact interval of a proportion, as fractions. n_trials > 0; the
/// hits need not be whole.
Interval exact_interval(double n_hits, double n_trials, double confidence = confidence_level);

}  // namespace heft
