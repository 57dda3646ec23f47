#include "psychophysics/ResponseModel.h"

#include <algorithm>
#include <cassert>

namespace heft {

namespace {
constexpr std::array<std::string_view, 4> psychometric_names{"threshold", "slope", "guess",
                                                             "lapse"};
constexpr std::array<std::string_view, 4> indecision_names{"sensitivity", "indecision", "bias",
                                                           "lapse"};
enum Outcome : std::size_t { negative = 0, positive = 1, reference = 0, none = 1, comparison = 2 };
}  // namespace

PsychometricFunction ResponseModel::psychometric() const {
  assert(!is_indecision());
  return {static_cast<PsychometricShape>(function), scale};
}

std::span<const std::string_view, 4> ResponseModel::parameter_names() const {
  return is_indecision() ? indecision_names : psychometric_names;
}

OutcomeShares ResponseModel::inattentive(const ParameterValues& parameters) const {
  const double guess = parameters[2], lapse = parameters[3];
  if (is_indecision()) return {lapse / 3, lapse / 3, lapse / 3};
  return {lapse, guess, 0};
}

OutcomeShares ResponseModel::attentive(const ParameterValues& parameters, double level) const {
  if (is_indecision()) {
    const IndecisionShares shares =
        indecision_shares({parameters[0], parameters[1], parameters[2], 0}, level);
    return {shares.reference, shares.none, shares.comparison};
  }
  const PsychometricFunction curve = psychometric();
  if (curve.takes_logarithm()) level = std::max(level, 0.0);  // unplanned levels may be negative
  const double u =
      curve.steepness(parameters[1]) * (curve.place(level) - curve.place(parameters[0]));
  const StandardCurve at = standard_curve(curve.shape, u);
  return {at.above, at.below, 0};
}

std::array<bool, 3> ResponseModel::outcomes_of(const Response& response) const {
  if (!is_indecision()) return {!response.positive, response.positive, false};
  if (!response.choice) return {response.positive, !response.positive, response.positive};
  return {response.choice == Choice::reference, response.choice == Choice::none,
          response.choice == Choice::comparison};
}

}  // namespace heft
