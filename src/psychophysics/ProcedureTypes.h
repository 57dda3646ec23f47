// Inputs and results of procedures: responses, reversals, stop reasons, estimates.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "base/Names.h"

namespace heft {

/// Levels are limited to +-largest_level, so that they and their means stay finite for all steps.
inline constexpr double largest_level = 1e300;

/// The stimulus that was chosen as the greater; none: no difference.
enum class Choice { comparison, reference, none };
template <>
struct EnumNames<Choice> {
  static constexpr std::array<std::string_view, 3> names{"comparison", "reference", "none"};
};

/// The response to a trial: positive or negative by the task's rule, and in comparisons the choice.
struct Response {
  bool positive = false;  ///< perceived, or correct
  std::optional<Choice> choice{};
};

/// The response "a difference was perceived" for either stimulus.
inline Response response_of(Choice choice) {
  return {choice != Choice::none, choice};
}

struct Reversal {
  int number = 0;  ///< from 1
  double level = 0;
  double step_before = 0, step_after = 0;  ///< step sizes in its direction, before and after it
};

/// Why a procedure ended: number of reversals, number of trials, or precision of the estimate.
enum class StopReason { reversals, trials, precision };
template <>
struct EnumNames<StopReason> {
  static constexpr std::array<std::string_view, 3> names{"reversals", "trials", "precision"};
};

/// The effect of one response.
struct Update {
  std::optional<Reversal> reversal;
  std::optional<StopReason> finish;
};

/// Whether an estimate is censored. above (below): the ceiling (floor) shortened moves that the
/// estimate depends on, so that the true value may be beyond the bound; indeterminate: both bounds
/// did, or the trials ended before the reversals. Bayesian kinds: the posterior reaches the upper
/// (lower) end of the grid; indeterminate: both ends, or the responses do not depend on the level.
enum class Censored { none, above, below, indeterminate };
template <>
struct EnumNames<Censored> {
  static constexpr std::array<std::string_view, 4> names{"none", "above", "below", "indeterminate"};
};

/// Estimate of one method. A procedure may have several.
struct Estimate {
  std::string method;
  /// The estimate in the unit of levels, and the limits of its interval; none: the method does not
  /// give it.
  std::optional<double> value{}, low{}, high{};
  int n_trials = 0, n_reversals = 0;
  int n_floor = 0, n_ceiling = 0;  ///< moves that a bound shortened
  Censored censored = Censored::none;
  std::optional<double> sd{};  ///< of the posterior, in Bayesian kinds
};

/// A parameter's posterior distribution. `mode` belongs to the most probable point of the whole
/// grid; low and high are the ends of the central 95 % interval.
struct ParameterPosterior {
  std::string name;
  double mean = 0, sd = 0, mode = 0, low = 0, high = 0;
};

}  // namespace heft
