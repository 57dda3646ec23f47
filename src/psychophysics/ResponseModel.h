// How the responses of a trial depend on its level, for procedures with a grid of parameters: the
// psychometric functions (two outcomes) and the indecision model (three), both of ObserverModels.h.
// Attentive trials have the outcomes of a function of the level; the others have fixed shares.
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "base/Names.h"
#include "psychophysics/ObserverModels.h"
#include "psychophysics/ProcedureTypes.h"

namespace heft {

/// The first four are those of PsychometricShape, in its order.
enum class ResponseFunction { cumulative_normal, logistic, weibull, gumbel, indecision };
template <>
struct EnumNames<ResponseFunction> {
  static constexpr std::array<std::string_view, 5> names{"cumulative_normal", "logistic", "weibull",
                                                         "gumbel", "indecision"};
};

/// By outcome: negative, positive; or reference, none, comparison.
using OutcomeShares = std::array<double, 3>;
/// The share of attentive trials. @param inattentive the shares of the other trials' outcomes
constexpr double attention(const OutcomeShares& inattentive) {
  return 1 - inattentive[0] - inattentive[1] - inattentive[2];
}
/// In the order of ResponseModel::parameter_names().
using ParameterValues = std::array<double, 4>;

struct ResponseModel {
  ResponseFunction function = ResponseFunction::cumulative_normal;
  LevelScale scale = LevelScale::linear;  ///< of the Weibull function

  bool operator==(const ResponseModel&) const = default;

  bool is_indecision() const { return function == ResponseFunction::indecision; }
  PsychometricFunction psychometric() const;
  /// threshold, slope, guess, lapse; or sensitivity, indecision, bias, lapse.
  std::span<const std::string_view, 4> parameter_names() const;
  std::size_t n_outcomes() const { return is_indecision() ? 3 : 2; }
  /// The first parameters determine attentive trials; the others are shares of guesses and lapses.
  std::size_t n_attentive() const { return is_indecision() ? 3 : 2; }

  /// The outcomes with these shares regardless of the level: guesses and lapses.
  OutcomeShares inattentive(const ParameterValues& parameters) const;
  /// Probabilities of the outcomes of an attentive trial; their sum is 1.
  OutcomeShares attentive(const ParameterValues& parameters, double level) const;
  /// The outcomes that a response can be. The indecision model takes a positive response without a
  /// choice as a choice of either stimulus.
  std::array<bool, 3> outcomes_of(const Response& response) const;
};

/// The level difference with 75 % correct forced choices without bias is this divided by the
/// sensitivity of the indecision model: the normal quantile of 0.75.
inline constexpr double threshold_75_times_sensitivity = 0.6744897501960817;

}  // namespace heft
