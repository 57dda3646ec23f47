// Sensitivity and criterion against another program's figures and against draws.
#include <gmock/gmock.h>

#include <cmath>

#include "base/Random.h"
#include "psychophysics/ObserverModels.h"

namespace heft {
namespace {

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
