// What every procedure takes and gives: answers, reversals, the end, estimates.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "base/Names.h"

namespace heft {

/// Levels are held within +-this, so that they and their means stay finite whatever the steps.
inline constexpr double largest_level = 1e300;

/// Which of two stimuli was said to be more; none: no difference.
enum class Choice { comparison, reference, none };
template <>
struct EnumNames<Choice> {
  static constexpr std::array<std::string_view, 3> names{"comparison", "reference", "none"};
};

/// The answer to a trial: yes or no by the rule of whoever asks, and where two stimuli were
/// compared, the choice itself.
struct Response {
  bool positive = false;  ///< perceived, correct
  std::optional<Choice> choice{};
};

/// A choice without a rule of its own: a difference was perceived, whichever was chosen.
inline Response response_of(Choice choice) {
  return {choice != Choice::none, choice};
}

struct Reversal {
  int number = 0;  ///< from 1
  double level = 0;
  double step_before = 0, step_after = 0;  ///< in force before and after it, in its own direction
};

/// Why a procedure ended: by its reversals, because it had all the trials that it may have, or
/// because its estimate is as precise as was asked for.
enum class StopReason { reversals, trials, precision };
template <>
struct EnumNames<StopReason> {
  static constexpr std::array<std::string_view, 3> names{"reversals", "trials", "precision"};
};

/// What one answer did.
struct Update {
  std::optional<Reversal> reversal;
  std::optional<StopReason> finish;
};

/// Whether an estimate is censored. above, below: the ceiling, the floor cut moves that it depends
/// on, so that the true value may lie beyond; indeterminate: both did, or the trials ran out before
/// the reversals.
enum class Censored { none, above, below, indeterminate };
template <>
struct EnumNames<Censored> {
  static constexpr std::array<std::string_view, 4> names{"none", "above", "below", "indeterminate"};
};

/// What one method makes of a procedure's trials; a procedure may have several.
struct Estimate {
  std::string method;
  std::optional<double> value{}, low{}, high{};  ///< none: it gives no such figure
  int n_trials = 0, n_reversals = 0;
  int n_floor = 0, n_ceiling = 0;  ///< moves that a bound cut short
  Censored censored = Censored::none;
};

}  // namespace heft
