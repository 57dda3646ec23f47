#include "base/math/Quantiles.h"

#include <gtest/gtest.h>

namespace heft {
namespace {

TEST(Quantile, InterpolatesBetweenOrderStatistics) {
  EXPECT_DOUBLE_EQ(*quantile({4, 1, 3, 2}, 0.5), 2.5);
  EXPECT_DOUBLE_EQ(*quantile({4, 1, 3, 2}, 0.25), 1.75);
  EXPECT_DOUBLE_EQ(*quantile({4, 1, 3, 2}, 1), 4);
  EXPECT_DOUBLE_EQ(*quantile({7}, 0.75), 7);
}

TEST(Quantile, QuartilesAreThreeOfThem) {
  const std::vector<double> values{4, 1, 3, 2, 9, 5};
  const auto found = quartiles(values);
  EXPECT_EQ(found->lower, quantile(values, 0.25));
  EXPECT_EQ(found->median, quantile(values, 0.5));
  EXPECT_EQ(found->upper, quantile(values, 0.75));
}

TEST(Quantile, OfNothingIsNone) {
  EXPECT_FALSE(quantile({}, 0.5).has_value());
  EXPECT_FALSE(quartiles({}).has_value());
}

}  // namespace
}  // namespace heft
