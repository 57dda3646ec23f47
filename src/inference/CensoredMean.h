// The mean of figures, some of which are only known to be above or below a value (censored), as
// the estimate of a staircase at its ceiling or floor is.
//
// Tobit model (Tobin 1958; both sides: Rosett & Nelson 1975): the figures, or the logarithms of
// figures that are positive, are normal with mean mu and SD sigma. An exact one counts with its
// density, a censored one with the probability of lying beyond. By maximum likelihood; the mean is
// mu, or exp(mu + sigma^2/2) for logarithms. Its interval is where the profile falls by at most
// n_exact/2 log(1 + t^2/(n_exact - 1)), t the 97.5 % quantile of Student's t with n_exact - 1
// degrees of freedom: without censoring and logarithms that is Student's interval itself. For
// logarithms it is positive and reaches further up than down.
// tests/inference/censored_mean_test.cpp measures the coverage.
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

/// Which are normally distributed over participants: the figures, or their logarithms.
enum class FigureModel { normal, log_normal };

struct CensoredMean {
  double mean = 0, sd = 0;  ///< of the figures under the model; sigma over n-1
  Interval interval;
};

/// None if the data do not determine it: half of the values or more are censored or missing; fewer
/// than two exact ones that differ, or for log_normal fewer than three or an interval whose limits
/// are a factor of 100 000 or more apart: the mean is then the model's extrapolation. A log-normal
/// figure is positive: an exact 0, or one below 0, counts as below the smallest positive value.
/// @param n_missing number of further, unknown values; they count as not exact
std::optional<CensoredMean> censored_mean(std::span<const CensoredValue> values, int n_missing = 0,
                                          FigureModel model = FigureModel::normal);

/// Kind of mean of several figures.
enum class MeanKind { none, mean, tobit_mean, log_normal_mean };
template <>
struct EnumNames<MeanKind> {
  static constexpr std::array<std::string_view, 4> names{"none", "mean", "tobit_mean",
                                                         "log_normal_mean"};
};

/// The figures of several people, of whom some are censored and some unknown.
struct FigureSummary {
  MeanKind kind = MeanKind::none;
  std::optional<double> mean, sd;    ///< none where half or fewer are exact; sd over n-1
  std::optional<Interval> interval;  ///< also none for one person or an SD of 0
};
/// censored_mean() where there is one; else, if all values are exact, their arithmetic mean without
/// an interval.
FigureSummary summarize_figures(std::span<const CensoredValue> values, int n_missing,
                                FigureModel model = FigureModel::normal);

/// The mean of one person's figures. None if one of them is unknown, or if one is censored above
/// and another one below.
std::optional<CensoredValue> mean_figure(std::span<const std::optional<CensoredValue>> figures);

/// First minus second; none as for the mean.
std::optional<CensoredValue> difference(const std::optional<CensoredValue>& first,
                                        const std::optional<CensoredValue>& second);

/// Whether no mean may be given: half or fewer of the values are exact.
bool mostly_censored(std::span<const CensoredValue> values, int n_missing);

}  // namespace heft
