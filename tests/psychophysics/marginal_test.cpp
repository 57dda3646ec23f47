// Distributions on a grid and the evidence that responses depend on the level, in closed form.
#include "psychophysics/Marginal.h"

#include <gtest/gtest.h>

#include <cmath>

#include "psychophysics/ObserverModels.h"

namespace heft {
namespace {

Marginal normal(double mean, double sd, double from, double to, int n) {
  Marginal marginal;
  double sum = 0;
  for (int i = 0; i < n; ++i) {
    marginal.values.push_back(from + (to - from) * i / (n - 1));
    marginal.weights.push_back(normal_density((marginal.values.back() - mean) / sd));
    sum += marginal.weights.back();
  }
  for (double& weight : marginal.weights) weight /= sum;
  return marginal;
}

TEST(Marginal, QuantilesAreInterpolatedInTheCumulativeWeights) {
  const Marginal marginal{{1, 2, 4}, {0.25, 0.5, 0.25}};
  EXPECT_DOUBLE_EQ(marginal.mean(), 2.25);
  EXPECT_DOUBLE_EQ(marginal.sd(), std::sqrt(0.25 * 1.5625 + 0.5 * 0.0625 + 0.25 * 3.0625));
  EXPECT_EQ(marginal.quantile(0.1), 1);  // before the first value's weight is complete
  EXPECT_DOUBLE_EQ(marginal.quantile(0.5), 1.5);
  EXPECT_DOUBLE_EQ(marginal.quantile(0.875), 3);
  EXPECT_EQ(marginal.quantile(1), 4);
}

TEST(Marginal, AFineGridHasTheNormalsMoments) {
  const Marginal marginal = normal(10, 2, 0, 20, 2001);
  EXPECT_NEAR(marginal.mean(), 10, 1e-9);
  EXPECT_NEAR(marginal.sd(), 2, 1e-4);  // without the tails beyond 5 SD
  EXPECT_NEAR(marginal.low(), 10 - 2 * 1.959964, 0.01);
  EXPECT_NEAR(marginal.high(), 10 + 2 * 1.959964, 0.01);
}

// Whatever the spacing of the grid.
TEST(Marginal, EndsAtTheGridIfTheNormalIntervalWould) {
  for (const int n : {21, 201, 2001}) {
    EXPECT_EQ(normal(10, 4.9, 0, 20, n).beyond(), Censored::none) << n;
    EXPECT_EQ(normal(9, 5, 0, 20, n).beyond(), Censored::below) << n;
    EXPECT_EQ(normal(11, 5, 0, 20, n).beyond(), Censored::above) << n;
    EXPECT_EQ(normal(10, 50, 0, 20, n).beyond(), Censored::indeterminate) << n;
  }
  EXPECT_EQ(Marginal({{3}, {1}}).beyond(), Censored::none);  // fixed
}

TEST(Marginal, InverseKeepsTheWeights) {
  const Marginal inverse = Marginal{{1, 2, 4}, {0.2, 0.3, 0.5}}.inverse(8);
  EXPECT_EQ(inverse.values, (std::vector<double>{2, 4, 8}));
  EXPECT_EQ(inverse.weights, (std::vector<double>{0.5, 0.3, 0.2}));
}

TEST(LogWeights, NeitherUnderflowNorForget) {
  LogWeights weights({0, 0});
  for (int i = 0; i < 10'000; ++i) weights.add({std::log(0.9), std::log(0.1)});
  EXPECT_EQ(weights.weights()[1], 0);
  for (int i = 0; i < 10'000; ++i) weights.add({std::log(0.1), std::log(0.9)});
  EXPECT_NEAR(weights.weights()[1], 0.5, 1e-6);
  EXPECT_NEAR(weights.log_evidence(), 10'000 * std::log(0.09), 1e-6);
}

// Of a sequence with k positive responses in n: 1 / ((n + 1) binomial(n, k)).
TEST(LevelEvidence, OfConstantProbabilitiesIsLaplaces) {
  LevelEvidence evidence(2);
  for (const bool positive : {true, false, true, true, false})
    evidence.add({!positive, positive, false});
  EXPECT_NEAR(evidence.for_model(0), -std::log(1.0 / (6 * 10)), 1e-12);
  LevelEvidence three(3);
  for (const std::size_t outcome : {0u, 1u, 2u, 2u}) {
    std::array<bool, 3> outcomes{};
    outcomes[outcome] = true;
    three.add(outcomes);
  }
  EXPECT_NEAR(three.for_model(0), -std::log(2.0 * 1 * 1 * 2 / 720),
              1e-12);  // 2! n! n! n! / (n + 2)!
}

TEST(LevelEvidence, IsNeutralWhileAllResponsesAreTheSame) {
  LevelEvidence evidence(2);
  for (int i = 0; i < 50; ++i) evidence.add({false, true, false});
  EXPECT_EQ(evidence.for_model(std::log(0.9)), 0);
}

TEST(ThresholdEstimate, HasAValueOnlyWhereItIsIdentifiable) {
  const Marginal inside = normal(10, 2, 0, 20, 201);
  const double strong = std::log(10), weak = std::log(2);
  EXPECT_NEAR(*threshold_estimate(inside, strong).value, 10, 1e-9);
  EXPECT_NEAR(*threshold_estimate(inside, strong).sd, 2, 1e-3);
  EXPECT_FALSE(threshold_estimate(inside, weak).value);
  EXPECT_EQ(threshold_estimate(inside, weak).censored, Censored::indeterminate);
  const Estimate above = threshold_estimate(normal(19, 2, 0, 20, 201), strong);
  EXPECT_EQ(above.censored, Censored::above);
  EXPECT_TRUE(above.low);
  EXPECT_FALSE(above.high || above.value);
  EXPECT_FALSE(threshold_estimate({{5}, {1}}, strong).value);  // fixed
}

}  // namespace
}  // namespace heft
