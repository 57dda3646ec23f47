// Means, spreads and intervals against closed forms and values computed with another program
// (mpmath, 25 digits).
#include "inference/Statistics.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numeric>

namespace heft {
namespace {

// P(X >= k) for X binomial(n, p), summed term by term.
double at_least(int k, int n, double p) {
  double sum = 0;
  for (int i = k; i <= n; ++i)
    sum += std::exp(std::lgamma(n + 1) - std::lgamma(i + 1) - std::lgamma(n - i + 1) +
                    i * std::log(p) + (n - i) * std::log1p(-p));
  return sum;
}

TEST(Statistics, SpreadIsOverNMinusOne) {
  const std::vector<double> values{60, 80, 100, 80};
  EXPECT_DOUBLE_EQ(*mean(values), 80);
  EXPECT_DOUBLE_EQ(*sample_sd(values), std::sqrt(800.0 / 3));
}

TEST(Statistics, WhatDoesNotExistIsNone) {
  const std::vector<double> one{5};
  EXPECT_FALSE(mean({}).has_value());
  EXPECT_FALSE(sample_sd(one).has_value());
  EXPECT_FALSE(student_t_interval(one).has_value());
}

TEST(Statistics, EqualValuesHaveNoSpreadDespiteRounding) {
  EXPECT_EQ(*sample_sd(std::vector<double>(7, 0.1)), 0);
}

TEST(Statistics, StudentIntervalOfThirteenParticipants) {
  const Interval interval = student_t_interval(172.3, 72.4, 13);  // t(12) = 2.17881282966723
  EXPECT_NEAR(interval.low, 128.549117869609, 1e-9);
  EXPECT_NEAR(interval.high, 216.050882130391, 1e-9);
}

TEST(Statistics, StudentIntervalFromValues) {
  const auto interval = student_t_interval(std::vector<double>{60, 80, 100, 80});
  EXPECT_NEAR(interval->low, 54.0154347274978, 1e-9);
  EXPECT_NEAR(interval->high, 105.984565272502, 1e-9);
}

TEST(Statistics, ExactIntervalAtTheEndsHasAClosedForm) {
  const double bound = 1 - std::pow(0.025, 1.0 / 65);
  EXPECT_EQ(exact_interval(0, 65).low, 0);
  EXPECT_NEAR(exact_interval(0, 65).high, bound, 1e-12);
  EXPECT_NEAR(exact_interval(65, 65).low, 1 - bound, 1e-12);
  EXPECT_EQ(exact_interval(65, 65).high, 1);
}

TEST(Statistics, ExactIntervalOfFiveInThirteen) {
  EXPECT_NEAR(exact_interval(5, 13).low, 0.138579338890161, 1e-12);
  EXPECT_NEAR(exact_interval(5, 13).high, 0.684222397085937, 1e-12);
}

RC_GTEST_PROP(Statistics, ExactIntervalLeavesItsTailOnEachSide, ()) {
  const int n = *rc::gen::inRange(2, 200);
  const int k = *rc::gen::inRange(1, n);
  const Interval interval = exact_interval(k, n);
  RC_ASSERT(std::abs(at_least(k, n, interval.low) - 0.025) < 1e-9);
  RC_ASSERT(std::abs(1 - at_least(k + 1, n, interval.high) - 0.025) < 1e-9);
}

}  // namespace
}  // namespace heft
