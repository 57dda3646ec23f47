// Bayesian procedures for tests: typical settings, observers, random settings.
#pragma once

#include <rapidcheck.h>

#include <cmath>
#include <set>
#include <vector>

#include "base/Random.h"
#include "psychophysics/LeastEntropy.h"
#include "psychophysics/Procedure.h"
#include "psychophysics/Quest.h"

namespace heft::test {

inline ValueGrid spaced(double from, double to, int n) {
  ValueGrid grid;
  for (int i = 0; i < n; ++i) grid.values.push_back(from + (to - from) * i / (n - 1));
  return grid;
}

inline ValueGrid ratios(double from, double to, int n) {
  ValueGrid grid;
  for (int i = 0; i < n; ++i) grid.values.push_back(from * std::pow(to / from, i / (n - 1.0)));
  return grid;
}

/// Yes/no detection: threshold and spread in g.
template <typename Config>
Config detection_of_grams(int trials) {
  Config config;
  config.levels = spaced(0, 400, 41);
  config.threshold = spaced(5, 395, 40);
  config.slope = ratios(5, 160, 8);
  config.guess = {{0.02}};
  config.lapse = {{0.02}};
  config.stop_trials = trials;
  return config;
}

/// The three-way task at 200 g.
inline PsiConfig heavier_at_200g(int trials) {
  PsiConfig config;
  config.function = ResponseFunction::indecision;
  config.levels = spaced(-180, 600, 40);
  config.sensitivity = ratios(0.001, 0.1, 25);
  config.indecision = spaced(0, 3, 13);
  config.bias = {{-0.5, 0, 0.5}};
  config.lapse = {{0.02, 0.1}};
  config.nuisance = {"bias", "lapse"};
  config.stop_trials = trials;
  return config;
}

/// Answers by the indecision model.
inline Response answer_of(const IndecisionParameters& observer, double level,
                          RandomStream& stream) {
  const IndecisionShares shares = indecision_shares(observer, level);
  const double drawn = stream.uniform();
  if (drawn < shares.comparison) return response_of(Choice::comparison);
  return response_of(drawn < shares.comparison + shares.reference ? Choice::reference
                                                                  : Choice::none);
}

/// Runs a procedure to its end. @param answer(level, stream) -> Response
template <typename Answer>
Estimate estimate_of(Procedure procedure, std::uint64_t seed, const Answer& answer) {
  RandomStream stream(seed, "observer");
  const RandomStream levels = level_stream(seed, procedure.name());
  while (!procedure.finished()) {
    const double level = procedure.next_level(levels);
    procedure.respond(answer(level, stream), level);
  }
  return procedure.estimates().front();
}

/// Up to `most` ascending multiples of `unit`.
inline ValueGrid any_grid(int from, int to, int most, double unit) {
  std::set<int> drawn;
  const int n = *rc::gen::inRange(1, most + 1);
  for (int i = 0; i < n; ++i) drawn.insert(*rc::gen::inRange(from, to));
  ValueGrid grid;
  for (const int value : drawn) grid.values.push_back(value * unit);
  return grid;
}

inline PsiConfig any_psi(int trials) {
  PsiConfig config;
  config.function = *rc::gen::element(ResponseFunction::cumulative_normal,
                                      ResponseFunction::logistic, ResponseFunction::weibull,
                                      ResponseFunction::gumbel, ResponseFunction::indecision);
  config.levels = any_grid(0, 60, 12, 2.5);
  config.lapse = any_grid(0, 40, 2, 0.01);
  const auto at_least_two = [](ValueGrid grid) {
    if (grid.values.size() == 1) grid.values.push_back(grid.values[0] + 1);
    return grid;
  };
  if (config.is_indecision()) {
    config.sensitivity = at_least_two(any_grid(1, 40, 6, 0.01));
    config.indecision = at_least_two(any_grid(0, 20, 5, 0.25));
    config.bias = any_grid(-8, 8, 3, 0.25);
  } else {
    config.threshold = at_least_two(any_grid(1, 60, 8, 2.5));
    config.slope = at_least_two(any_grid(1, 40, 4, 0.5));
    config.guess = any_grid(0, 50, 2, 0.01);
  }
  if (*rc::gen::arbitrary<bool>()) config.nuisance = {"lapse"};
  config.stop_trials = trials;
  return config;
}

inline Response any_response() {
  return {*rc::gen::arbitrary<bool>(),
          *rc::gen::element<std::optional<Choice>>(Choice::comparison, Choice::reference,
                                                   Choice::none, std::nullopt)};
}

}  // namespace heft::test
