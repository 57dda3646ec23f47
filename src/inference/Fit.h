// Maximum-likelihood fits of answers at several levels: psychometric functions, and the three-way
// choice of the indecision model. An estimate that is not identifiable has no value, and `why` has
// the reason.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "psychophysics/ObserverModels.h"

namespace heft {

/// The normal quantile of 75 %, with the digits that are usual in the field: threshold_75_g is
/// this, divided by the sensitivity.
inline constexpr double z_75 = 0.6745;

/// How often each answer was given, by level. Psychometric: negative, positive. Indecision:
/// reference, none, comparison.
using AnswersByLevel = std::map<double, std::array<double, 3>>;

struct FitOptions {
  PsychometricFunction function{};  ///< not for indecision
  /// None: free, between 0 and 1/2 (less where a fixed guess leaves less). guess: not for
  /// indecision
  std::optional<double> guess = 0, lapse = 0;
};

struct FittedParameter {
  std::string name;
  /// None: not identifiable. An interval's end is none where it is infinite.
  std::optional<double> value{};
  std::optional<double> se{};  ///< also none where the value is fixed or at a bound
  std::optional<double> low{}, high{};
  bool fixed = false;
};

struct Fit {
  std::vector<FittedParameter> parameters;
  std::optional<double> log_likelihood;  ///< without binomial coefficients
  double n_trials = 0;
  std::size_t n_levels = 0;
  std::string why;  ///< reason that there is no threshold; empty: there is one

  bool identifiable() const { return why.empty(); }
  const FittedParameter& parameter(std::string_view name) const;
};

/// Parameters: threshold, slope, guess, lapse. Without a threshold the free ones have no value.
/// Identifiable: a constant probability is rejected (likelihood ratio at 95 %, a degree of freedom
/// for each further parameter), no step fits as well, and the threshold's interval extends beyond
/// the levels by at most their range.
Fit fit_psychometric(const AnswersByLevel& answers, const FitOptions& options);

/// Parameters: sensitivity, indecision, bias, lapse, and threshold_75_g: the level with 75 %
/// correct forced choices without bias.
/// Identifiable: the sensitivity's interval is above 0, and the threshold's ends at most at twice
/// reach_of(). Otherwise there is no threshold, but the others may have values.
Fit fit_indecision(const AnswersByLevel& answers, const FitOptions& options);

/// Fits "same" (first) and "different" answers to two stimuli that differ by a level of either
/// sign: the indecision model without bias, where both choices count as "different" (the
/// differencing model of same-different tasks: Macmillan & Creelman 2005, ch. 9). Parameters:
/// sensitivity, indecision, lapse, and threshold_75_g, that of a forced choice, which does not
/// depend on the criterion. Identifiable as fit_indecision().
/// @param lapse rate of random answers, each of the two with probability 1/2
Fit fit_same_different(const AnswersByLevel& answers, double lapse);

/// The lapse rate where the answers of too few people would have to identify it: a single lapse
/// must not bend the curve (Wichmann & Hill 2001).
inline constexpr double fixed_lapse = 0.02;

struct ForcedChoiceFit {
  FittedParameter threshold;           ///< difference that makes 75 % of the choices correct
  std::optional<FittedParameter> pse;  ///< levels of both signs have one
  std::string why;                     ///< reason that there is no threshold; empty: there is one
};

/// Fits choices of the reference (first) and the comparison, by their difference, with fixed_lapse.
/// With levels of both signs the curve rises from 0 to 1: its center is the point of subjective
/// equality, and its spread the noise. With positive levels only it rises from 1/2: its center is
/// the threshold.
ForcedChoiceFit fit_forced_choice(const AnswersByLevel& answers);

/// Minimum number of trials: chi-square intervals do not hold for fewer.
inline constexpr double least_trials_to_fit = 10;

// Shared by fit_indecision and fit_psychometric.

/// How far the presented levels extend: the largest distance from the reference; of absolute
/// masses, which have no reference at 0, the range from the lightest to the heaviest.
struct LevelReach {
  double level_g = 0;
  bool is_range = false;  ///< otherwise the largest level
};
LevelReach reach_of(const AnswersByLevel& answers);

/// A sensitivity's 95 % interval, per gram; an end at infinity is none.
struct SensitivityRange {
  std::optional<double> low{}, high{};

  bool flat() const { return !low && !high; }  ///< none is ruled out
  /// Any that is large enough fits within 95 %, and none below 0.
  bool separated() const { return !high && low.value_or(0) > 0; }
};

/// Why a sensitivity gives no threshold, as heft fit and the report say it; empty: it gives one.
std::string why_no_threshold(const SensitivityRange& range, const LevelReach& reach);

/// Number of each answer, over all levels.
std::array<double, 3> totals(const AnswersByLevel& answers);

/// Sum of all answers.
double trials_in(const AnswersByLevel& answers);

/// The largest absolute level in grams; 0 without levels.
double largest_level_of(const AnswersByLevel& answers);

/// Why no model can be fitted: "there are no trials", "there is one level"... Empty: one can.
std::string too_little(const AnswersByLevel& answers);

/// As too_little(), for choices (reference, none, comparison; or left, none, right).
std::string too_little_chosen(const AnswersByLevel& answers);

/// The limit of the log likelihood as the curves become infinitely steep: the boundary between two
/// neighboring answers becomes a step between two levels, or at one level, where any share fits.
/// @param least smallest probability of each answer, by guesses and lapses
double log_likelihood_of_steps(const AnswersByLevel& answers, std::span<const double> least);

/// n log p and its first and second derivative by p. p counts as at least 1e-300.
struct LogShare {
  double value, slope, curvature;
};
LogShare log_share(double n, double p);

}  // namespace heft
