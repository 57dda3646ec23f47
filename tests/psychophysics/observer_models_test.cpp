// Observer models against known values of their formulas, each other, another program and random
// draws.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "base/Random.h"
#include "psychophysics/ObserverModels.h"

namespace heft {
namespace {

using enum PsychometricShape;
constexpr std::array all_shapes{cumulative_normal, logistic, weibull, gumbel};

double any_number(double low, double high) {
  return low + (high - low) * *rc::gen::inRange(0, 1000001) / 1e6;
}

TEST(PsychometricFunction, AtTheThreshold) {
  const PsychometricParameters parameters{3, 2, 0.5, 0.02};
  const double half = 0.5 + 0.48 / 2, most = 0.5 + 0.48 * (1 - std::exp(-1));
  EXPECT_DOUBLE_EQ(probability({cumulative_normal, {}}, parameters, 3), half);
  EXPECT_DOUBLE_EQ(probability({logistic, {}}, parameters, 3), half);
  EXPECT_DOUBLE_EQ(probability({gumbel, {}}, parameters, 3), most);
  for (const LevelScale scale : {LevelScale::linear, LevelScale::log10, LevelScale::db})
    EXPECT_DOUBLE_EQ(probability({weibull, scale}, parameters, 3), most);
}

TEST(PsychometricFunction, ASlopeFromTheThreshold) {
  const PsychometricParameters spread{3, 2, 0, 0};
  EXPECT_NEAR(probability({cumulative_normal, {}}, spread, 5), 0.841344746068543, 1e-15);
  EXPECT_NEAR(probability({logistic, {}}, spread, 5), 0.731058578630005, 1e-15);
  EXPECT_NEAR(probability({gumbel, {}}, spread, 5), 1 - std::exp(-std::exp(1)), 1e-15);
  const PsychometricParameters exponent{10, 3.5, 0, 0};
  EXPECT_NEAR(probability({weibull, LevelScale::linear}, exponent, 20),
              1 - std::exp(-std::pow(2, 3.5)), 1e-15);
  EXPECT_EQ(probability({weibull, LevelScale::linear}, exponent, 0), 0);
}

RC_GTEST_PROP(PsychometricFunction, WeibullIsTheSameOnAnyScale, ()) {
  const double level = any_number(0.01, 100), threshold = any_number(0.01, 100);
  const double slope = any_number(0.3, 6);
  const double linear =
      probability({weibull, LevelScale::linear}, {threshold, slope, 0.3, 0.1}, level);
  const double log10 = probability({weibull, LevelScale::log10},
                                   {std::log10(threshold), slope, 0.3, 0.1}, std::log10(level));
  const double db =
      probability({weibull, LevelScale::db}, {20 * std::log10(threshold), slope, 0.3, 0.1},
                  20 * std::log10(level));
  RC_ASSERT(std::abs(linear - log10) < 1e-12);
  RC_ASSERT(std::abs(linear - db) < 1e-12);
}

RC_GTEST_PROP(PsychometricFunction, RisesFromGuessToOneMinusLapse, ()) {
  const PsychometricFunction function{*rc::gen::elementOf(all_shapes), LevelScale::log10};
  const PsychometricParameters parameters{any_number(-5, 5), any_number(0.1, 5), any_number(0, 0.5),
                                          any_number(0, 0.3)};
  const double low = any_number(-50, 50), high = low + any_number(0, 10);
  const double p_low = probability(function, parameters, low);
  const double p_high = probability(function, parameters, high);
  RC_ASSERT(parameters.guess <= p_low);
  RC_ASSERT(p_low <= p_high);
  RC_ASSERT(p_high <= 1 - parameters.lapse + 1e-15);
}

TEST(PsychometricFunction, TailsKeepTheirDigits) {
  EXPECT_NEAR(standard_curve(cumulative_normal, 9).above / 1.1285884059538405e-19, 1, 1e-12);
  EXPECT_NEAR(standard_curve(cumulative_normal, -9).below / 1.1285884059538405e-19, 1, 1e-12);
  EXPECT_NEAR(standard_curve(logistic, 80).above / std::exp(-80), 1, 1e-12);
  EXPECT_NEAR(standard_curve(gumbel, -60).below / std::exp(-60), 1, 1e-12);
}

RC_GTEST_PROP(PsychometricFunction, DensityIsTheDerivative, ()) {
  const PsychometricShape shape = *rc::gen::elementOf(all_shapes);
  const double u = any_number(-4, 2), step = 1e-5;
  const double slope =
      (standard_curve(shape, u + step).below - standard_curve(shape, u - step).below) / (2 * step);
  RC_ASSERT(std::abs(standard_curve(shape, u).density - slope) < 1e-8);
  const double bend =
      (standard_curve(shape, u + step).density - standard_curve(shape, u - step).density) /
      (2 * step);
  RC_ASSERT(std::abs(standard_curve(shape, u).density_slope - bend) < 1e-8);
}

TEST(PsychometricFunction, IsFlatFarFromTheThreshold) {
  for (const PsychometricShape shape : all_shapes)
    for (const double u : {-1000., 1000.}) {
      EXPECT_EQ(standard_curve(shape, u).density, 0) << name_of(shape);
      EXPECT_EQ(standard_curve(shape, u).density_slope, 0) << name_of(shape);
    }
}

RC_GTEST_PROP(PsychometricFunction, PlaceAndSteepnessCanBeUndone, ()) {
  for (const LevelScale scale : {LevelScale::linear, LevelScale::log10, LevelScale::db}) {
    const PsychometricFunction function{*rc::gen::elementOf(all_shapes), scale};
    const double value = any_number(0.01, 50);
    RC_ASSERT(std::abs(function.level(function.place(value)) / value - 1) < 1e-12);
    RC_ASSERT(std::abs(function.slope(function.steepness(value)) / value - 1) < 1e-12);
  }
}

TEST(IndecisionShares, WithoutDifferenceAndBiasBothCubesAreAlike) {
  const IndecisionShares p = indecision_shares({0.01, 1, 0, 0}, 0);
  EXPECT_DOUBLE_EQ(p.reference, p.comparison);
  EXPECT_NEAR(p.none, 0.682689492137086, 1e-15);
}

TEST(IndecisionShares, WithoutIndecisionItIsAForcedChoice) {
  const IndecisionShares p = indecision_shares({0.01, 0, 0, 0}, 67.44897501960817);
  EXPECT_NEAR(p.comparison, 0.75, 1e-14);
  EXPECT_NEAR(p.none, 0, 1e-15);
}

RC_GTEST_PROP(IndecisionShares, SumToOneAndLapsesAreAnyOfThem, ()) {
  const IndecisionParameters parameters{any_number(-0.1, 0.1), any_number(0, 4), any_number(-2, 2),
                                        any_number(0, 1)};
  const IndecisionShares p = indecision_shares(parameters, any_number(-500, 500));
  RC_ASSERT(std::abs(p.reference + p.none + p.comparison - 1) < 1e-14);
  RC_ASSERT(std::min({p.reference, p.none, p.comparison}) >= parameters.lapse / 3);
}

TEST(IndecisionShares, ANarrowBandFarOutKeepsItsDigits) {
  // Phi(-20 + 1e-9) - Phi(-20 - 1e-9), nearly 2e-9 times the density
  const IndecisionShares p = indecision_shares({1, 1e-9, 0, 0}, 20);
  EXPECT_NEAR(p.none / (2e-9 * normal_density(20)), 1, 1e-5);
}

TEST(Detection, QuantilesOfTheNormalDistribution) {
  EXPECT_NEAR(normal_quantile(0.5), 0, 1e-15);
  EXPECT_NEAR(normal_quantile(0.975), 1.959963984540054, 1e-13);
  EXPECT_NEAR(normal_quantile(0.001), -3.090232306167813, 1e-13);
  EXPECT_NEAR(normal_quantile(1e-10), -6.361340902404056, 1e-12);
}

// Python's statistics.NormalDist by the same formulas.
TEST(Detection, FiguresOfAnotherProgram) {
  const auto many = detection({99, 83, 99, 15});
  ASSERT_TRUE(many);
  EXPECT_NEAR(many->d_prime, 1.989335910276337, 1e-12);
  EXPECT_NEAR(many->criterion, 0.02055407807885956, 1e-12);
  EXPECT_NEAR(many->d_prime_se, 0.21420661309967529, 1e-12);
  EXPECT_NEAR(many->criterion_se, many->d_prime_se / 2, 1e-15);
}

TEST(Detection, PerfectAnswersHaveFiniteFigures) {
  const auto perfect = detection({10, 10, 4, 0});
  ASSERT_TRUE(perfect);
  EXPECT_NEAR(perfect->d_prime, 2.972173195129499, 1e-12);
  EXPECT_NEAR(perfect->d_prime_se, 1.098045500248105, 1e-12);
}

TEST(Detection, NoneWithoutTrialsOfEitherKind) {
  EXPECT_FALSE(detection({10, 5, 0, 0}));
  EXPECT_FALSE(detection({0, 0, 10, 5}));
}

TEST(Detection, TheStandardErrorIsTheSpreadOfTheEstimate) {
  RandomStream draws(1, "detection");
  const int n = 200, n_people = 4000;
  double sum = 0, sum_squared = 0, sum_se = 0;
  for (int i = 0; i < n_people; ++i) {
    DetectionCounts counts{n, 0, n, 0};
    for (int k = 0; k < n; ++k) {
      counts.n_hits += draws.coin(0.8);
      counts.n_false_alarms += draws.coin(0.2);
    }
    const auto found = detection(counts);
    sum += found->d_prime;
    sum_squared += found->d_prime * found->d_prime;
    sum_se += found->d_prime_se;
  }
  const double mean = sum / n_people;
  EXPECT_NEAR(mean, 2 * normal_quantile(0.8), 0.02);
  EXPECT_NEAR(sum_se / n_people, std::sqrt(sum_squared / n_people - mean * mean), 0.008);
}

}  // namespace
}  // namespace heft
