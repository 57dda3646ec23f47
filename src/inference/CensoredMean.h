// The mean of figures of which some are only known to lie above or below a value, as for a
// staircase at its ceiling or floor.
//
// Tobit model (Tobin 1958; both sides: Rosett & Nelson 1975): the figures are normal with mean mu
// and SD sigma, an exact one counts with its density, a censored one with the probability of lying
// beyond. By maximum likelihood over 1/sigma and mu/sigma, in which it is concave (Olsen 1978). The
// interval of mu is where the profile falls by at most n_exact/2 log(1 + t^2/(n_exact - 1)), t
// the 97.5 % quantile of Student's t with n_exact - 1 degrees of freedom: without censoring that is
// Student's interval itself. tests/inference/censored_mean_test.cpp shows how often it holds the
// mean.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>

#include "base/Names.h"
#include "inference/Statistics.h"
#include "psychophysics/ProcedureTypes.h"

namespace heft {

/// A figure, or what it is known to lie above or below.
struct CensoredValue {
  double value = 0;
  Censored censored = Censored::none;  ///< none, above or below; otherwise not a value
};

struct CensoredMean {
  double mean = 0, sd = 0;  ///< sd: over n-1, as without censoring
  Interval interval;
};

/// None where it takes more to say it: fewer than two exact values that differ, or half of the
/// values or more censored. One value, or an SD of 0, has no interval.
/// @param n_missing further ones of which nothing is known; they count as not exact
std::optional<CensoredMean> censored_mean(std::span<const CensoredValue> values, int n_missing = 0);

/// What the mean of several figures is.
enum class MeanKind { none, mean, tobit_mean };
template <>
struct EnumNames<MeanKind> {
  static constexpr std::array<std::string_view, 3> names{"none", "mean", "tobit_mean"};
};

/// The figures of several people, of whom some are censored and some unknown.
struct FigureSummary {
  MeanKind kind = MeanKind::none;
  std::optional<double> mean, sd;    ///< none where half or fewer are exact; sd over n-1
  std::optional<Interval> interval;  ///< also none for one person or an SD of 0
};
FigureSummary summarize_figures(std::span<const CensoredValue> values, int n_missing);

/// The mean of one person's figures. None where any of them is unknown, or one is known to lie
/// above and one below what it gives.
std::optional<CensoredValue> mean_figure(std::span<const std::optional<CensoredValue>> figures);

/// None as for the mean.
std::optional<CensoredValue> difference(const std::optional<CensoredValue>& first,
                                        const std::optional<CensoredValue>& second);

/// Whether so few of them are exact that no mean may be given: half or fewer.
bool mostly_censored(std::span<const CensoredValue> values, int n_missing);

}  // namespace heft
