// One person's likelihood, integrated over their effects: against sums over a dense grid and
// against finite differences.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "base/Random.h"
#include "inference/PersonIntegral.h"
#include "psychophysics/ObserverModels.h"

namespace heft {
namespace {

// A random population and a person drawn from it.
struct Example {
  Parameters population = Parameters(n_population_parameters);
  std::vector<LevelAnswers> answers;
};

Example example(std::uint64_t seed) {
  RandomStream stream(seed, "person integral");
  const auto between = [&](double low, double high) {
    return low + (high - low) * stream.uniform();
  };
  Example of;
  of.population << between(0, 2), between(-1, 1), std::log(between(0.2, 0.8)),
      std::log(between(0.2, 0.8)), std::atanh(between(-0.7, 0.7)), std::log(between(0.1, 0.5)),
      between(0.005, 0.15);
  const double s = std::exp(of.population[mean_log_sensitivity] + 0.4 * stream.normal());
  const double tau = std::exp(of.population[mean_log_criterion] + 0.4 * stream.normal());
  for (int i = 1; i <= 10; ++i) {
    const double level = (stream.coin(0.5) ? 0.1 : -0.1) * i;
    LevelAnswers here{level, {}};
    for (int k = 0; k < 3; ++k) {
      const double felt = s * level + stream.normal();
      here.n[felt > tau ? comparison_answer : felt < -tau ? reference_answer : none_answer] += 1;
    }
    of.answers.push_back(here);
  }
  return of;
}

double given_effects(const Example& of, double log_s, double log_tau, double bias) {
  double sum = 0;
  for (const LevelAnswers& here : of.answers) {
    const IndecisionShares shares = indecision_shares(
        {std::exp(log_s), std::exp(log_tau), bias, of.population[shared_lapse]}, here.level);
    sum += here.n[reference_answer] * std::log(shares.reference) +
           here.n[none_answer] * std::log(shares.none) +
           here.n[comparison_answer] * std::log(shares.comparison);
  }
  return sum;
}

// The trapezoidal rule is very accurate for functions that fall to 0 on both sides.
double by_grid(const Example& of) {
  const Parameters& at = of.population;
  const double rho = std::tanh(at[arctanh_correlation]);
  constexpr double step = 0.2, end = 6;
  double sum = 0;
  for (double a = -end; a <= end; a += step)
    for (double b = -end; b <= end; b += step)
      for (double c = -end; c <= end; c += step) {
        const double log_s = at[mean_log_sensitivity] + std::exp(at[log_sd_sensitivity]) * a;
        const double log_tau =
            at[mean_log_criterion] +
            std::exp(at[log_sd_criterion]) * (rho * a + std::sqrt(1 - rho * rho) * b);
        sum += std::exp(given_effects(of, log_s, log_tau, std::exp(at[log_sd_bias]) * c) -
                        (a * a + b * b + c * c) / 2);
      }
  return std::log(sum * std::pow(step / std::sqrt(2 * std::numbers::pi), 3));
}

TEST(PersonIntegral, IsTheSumOverADenseGrid) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const Example of = example(seed);
    PersonIntegral person(of.answers);
    person.center(of.population);
    EXPECT_NEAR(person.log_likelihood(of.population, nullptr), by_grid(of), 0.01) << seed;
  }
}

TEST(PersonIntegral, HasTheDerivativesThatDifferencesHave) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Example of = example(seed);
    PersonIntegral person(of.answers);
    person.center(of.population);
    const auto derivatives_at = [&](const Parameters& at) {
      Derivatives found{Parameters::Zero(n_population_parameters),
                        Curvature::Zero(n_population_parameters, n_population_parameters)};
      person.log_likelihood(at, &found);
      return found;
    };
    const Derivatives here = derivatives_at(of.population);
    for (Eigen::Index i = 0; i < n_population_parameters; ++i) {
      constexpr double step = 1e-5;
      Parameters up = of.population, down = of.population;
      up[i] += step;
      down[i] -= step;
      const double slope =
          (person.log_likelihood(up, nullptr) - person.log_likelihood(down, nullptr)) / (2 * step);
      EXPECT_NEAR(here.gradient[i], slope, 1e-6 * (1 + std::abs(slope))) << seed << " " << i;
      const Parameters bend =
          (derivatives_at(up).gradient - derivatives_at(down).gradient) / (2 * step);
      for (Eigen::Index k = 0; k < n_population_parameters; ++k)
        EXPECT_NEAR(here.hessian(i, k), bend[k], 1e-5 * (1 + std::abs(bend[k])))
            << seed << " " << i << " " << k;
    }
  }
}

// Mirrored levels and answers have the same likelihood.
TEST(PersonIntegral, HasNoPreferredSide) {
  Example of = example(3);
  PersonIntegral person(of.answers);
  for (LevelAnswers& here : of.answers) {
    here.level = -here.level;
    std::swap(here.n[reference_answer], here.n[comparison_answer]);
  }
  PersonIntegral mirrored(of.answers);
  person.center(of.population);
  mirrored.center(of.population);
  EXPECT_NEAR(person.log_likelihood(of.population, nullptr),
              mirrored.log_likelihood(of.population, nullptr), 1e-9);
}

}  // namespace
}  // namespace heft
