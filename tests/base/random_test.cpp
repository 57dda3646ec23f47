#include "base/Random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

namespace heft {
namespace {

// From a separate implementation of Philox4x64-10 (in Python), which gives Random123's published
// vector 16554d9eca36314c db20fe9d672d0fdc d7e772cee186176b 7e68b68aec7ba23b for zero key and
// counter.
TEST(Random, StreamsArePhiloxKeyedBySeedAndPurposeAndCountedByTrialAndAttempt) {
  RandomStream stream(42, "slots", 7, 2);
  for (std::uint64_t expected :
       {0x195d029b4e203158ull, 0x8f419ff464aaff7dull, 0x104fecd5e09924f6ull, 0x552cba7e8b20154cull,
        0x31e8ef0138a5b896ull, 0x657b5ad61459bfdbull, 0x4587ee14ad091bf7ull, 0x4063383c8ba05effull})
    EXPECT_EQ(stream.bits(), expected);
}

TEST(Random, EqualKeysGiveEqualStreamsAndOthersDoNot) {
  const auto first = [](RandomStream stream) { return stream.bits(); };
  const std::uint64_t value = first(RandomStream(1, "a", 2, 3));
  EXPECT_EQ(first(RandomStream(1, "a", 2, 3)), value);
  EXPECT_NE(first(RandomStream(2, "a", 2, 3)), value);
  EXPECT_NE(first(RandomStream(1, "b", 2, 3)), value);
  EXPECT_NE(first(RandomStream(1, "a", 3, 3)), value);
  EXPECT_NE(first(RandomStream(1, "a", 2, 4)), value);
}

TEST(Random, BoundedDrawsAreUniform) {
  constexpr int n = 60000, bound = 6;
  std::map<std::uint64_t, int> counts;
  RandomStream stream(3, "below");
  for (int i = 0; i < n; ++i) ++counts[stream.below(bound)];
  const double expected = static_cast<double>(n) / bound;
  double chi_squared = 0;
  for (std::uint64_t k = 0; k < bound; ++k)
    chi_squared += std::pow(counts[k] - expected, 2) / expected;
  EXPECT_EQ(counts.size(), static_cast<std::size_t>(bound));
  EXPECT_LT(chi_squared, 20.5);  // 5 degrees of freedom, 0.1 %
}

TEST(Random, UniformAndNormalDrawsHaveTheirMoments) {
  constexpr int n = 100000;
  RandomStream stream(4, "moments");
  double sum = 0, sum_squares = 0, uniform_sum = 0;
  for (int i = 0; i < n; ++i) {
    const double u = stream.uniform(), z = stream.normal();
    ASSERT_GE(u, 0);
    ASSERT_LT(u, 1);
    uniform_sum += u;
    sum += z;
    sum_squares += z * z;
  }
  // Four standard errors.
  EXPECT_NEAR(uniform_sum / n, 0.5, 4 * 0.2887 / std::sqrt(n));
  EXPECT_NEAR(sum / n, 0, 4 / std::sqrt(n));
  EXPECT_NEAR(sum_squares / n, 1, 4 * std::sqrt(2.0 / n));
}

TEST(Random, EveryOrderOfAShuffleIsEquallyLikely) {
  constexpr int n = 60000;
  std::map<std::vector<int>, int> counts;
  RandomStream stream(5, "shuffle");
  for (int i = 0; i < n; ++i) {
    std::vector<int> items{1, 2, 3};
    stream.shuffle(std::span(items));
    ++counts[items];
  }
  ASSERT_EQ(counts.size(), 6u);
  for (const auto& [order, count] : counts) EXPECT_NEAR(count, n / 6.0, 4 * std::sqrt(n / 6.0));
}

}  // namespace
}  // namespace heft
