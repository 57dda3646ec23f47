#include "inference/checks/GoodnessOfFit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/Random.h"
#include "psychophysics/ObserverModels.h"

namespace heft {

namespace {
constexpr int n_simulations = 1000;
constexpr double same_deviance = 1e-6;  // equal answers have equal deviances but for rounding

using Shares = std::array<double, 3>;  // of the answers at a level

double trials_at(const std::array<double, 3>& n) {
  return n[0] + n[1] + n[2];
}

double saturated_log_likelihood(const AnswersByLevel& answers) {
  double sum = 0;
  for (const auto& [level, n] : answers)
    for (const double n_given : n) sum += log_share(n_given, n_given / trials_at(n)).value;
  return sum;
}

std::string why_not(const AnswersByLevel& answers, const Fit& fit, int degrees_of_freedom) {
  if (!fit.identifiable()) return "there is no threshold";
  const auto [fewest, most] = std::ranges::minmax_element(
      answers, {}, [](const auto& level) { return trials_at(level.second); });
  const double n_fewest = trials_at(fewest->second), n_most = trials_at(most->second);
  if (n_most > most_unequal_levels * n_fewest)
    return fmt::format(
        "levels have {:g} to {:g} trials, as where an adaptive procedure chose them by earlier "
        "answers: other answers would have led to other levels",
        n_fewest, n_most);
  if (n_fewest < least_trials_at_level)
    return fmt::format("{:g} trials at a level are too few, expected {:g} or more", n_fewest,
                       least_trials_at_level);
  if (degrees_of_freedom < 1)
    return fmt::format("{} levels leave nothing to judge the fit by: it has as many parameters",
                       answers.size());
  return "";
}

AnswersByLevel drawn(const AnswersByLevel& answers, const std::map<double, Shares>& shares,
                     RandomStream& stream) {
  AnswersByLevel simulated;
  for (const auto& [level, n] : answers) {
    const Shares& p = shares.at(level);
    auto& counts = simulated[level];
    for (double i = 0; i < trials_at(n); ++i) {
      const double u = stream.uniform();
      counts[u < p[0] ? 0 : u < p[0] + p[1] ? 1 : 2] += 1;
    }
  }
  return simulated;
}

// @param refitted the log likelihood of other answers after a fit
GoodnessOfFit check(const AnswersByLevel& answers, const Fit& fit, int n_answers,
                    const std::function<Shares(double)>& shares_at,
                    const std::function<double(const AnswersByLevel&)>& refitted) {
  GoodnessOfFit found;
  found.degrees_of_freedom =
      static_cast<int>(answers.size()) * (n_answers - 1) -
      static_cast<int>(std::ranges::count_if(fit.parameters, [](const FittedParameter& parameter) {
        return !parameter.fixed && parameter.name != "threshold_75_g";
      }));
  found.why = why_not(answers, fit, found.degrees_of_freedom);
  if (!found.why.empty()) return found;
  found.deviance = 2 * (saturated_log_likelihood(answers) - *fit.log_likelihood);
  std::map<double, Shares> shares;
  for (const auto& [level, n] : answers) shares[level] = shares_at(level);
  RandomStream stream(1, "goodness of fit");
  int n_as_large = 0;
  for (int i = 0; i < n_simulations; ++i) {
    const AnswersByLevel simulated = drawn(answers, shares, stream);
    const double deviance = 2 * (saturated_log_likelihood(simulated) - refitted(simulated));
    n_as_large += deviance >= *found.deviance - same_deviance ? 1 : 0;
  }
  found.n_simulated = n_simulations;
  found.p = (n_as_large + 1.0) / (n_simulations + 1.0);
  return found;
}
}  // namespace

GoodnessOfFit check_psychometric(const AnswersByLevel& answers, const FitOptions& options,
                                 const Fit& fit) {
  const auto value = [&](const char* name) { return fit.parameter(name).value.value_or(0); };
  const PsychometricParameters parameters{value("threshold"), value("slope"), value("guess"),
                                          value("lapse")};
  return check(
      answers, fit, 2,
      [&](double level) {
        const double p = probability(options.function, parameters, level);
        return Shares{1 - p, p, 0};
      },
      [&](const AnswersByLevel& simulated) {
        return refitted_psychometric(simulated, options, fit);
      });
}

GoodnessOfFit check_indecision(const AnswersByLevel& answers, const FitOptions& options,
                               const Fit& fit) {
  const auto value = [&](const char* name) { return fit.parameter(name).value.value_or(0); };
  const IndecisionParameters parameters{value("sensitivity"), value("indecision"), value("bias"),
                                        value("lapse")};
  return check(
      answers, fit, 3,
      [&](double level) {
        const IndecisionShares p = indecision_shares(parameters, level);
        return Shares{p.reference, p.none, p.comparison};
      },
      [&](const AnswersByLevel& simulated) {
        return refitted_indecision(simulated, options, fit);
      });
}

GoodnessOfFit check_forced_choice(const AnswersByLevel& answers) {
  const FitOptions options = forced_choice_options(answers);
  return check_psychometric(answers, options, fit_psychometric(answers, options));
}

GoodnessOfFit check_same_different(const AnswersByLevel& answers) {
  AnswersByLevel either_sign;
  for (const auto& [level, n] : answers)
    for (std::size_t k = 0; k < n.size(); ++k) either_sign[std::abs(level)][k] += n[k];
  const Fit fit = fit_same_different(either_sign, fixed_lapse);
  const auto value = [&](const char* name) { return fit.parameter(name).value.value_or(0); };
  const IndecisionParameters parameters{value("sensitivity"), value("indecision"), 0, 0};
  return check(
      either_sign, fit, 2,
      [&](double level) {
        const double none = indecision_shares(parameters, level).none;
        const double same = fixed_lapse / 2 + (1 - fixed_lapse) * none;
        return Shares{same, 1 - same, 0};
      },
      [&](const AnswersByLevel& simulated) { return refitted_same_different(simulated, fit); });
}

}  // namespace heft
