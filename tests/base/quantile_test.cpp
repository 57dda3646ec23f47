#include "base/Quantile.h"

#include <gtest/gtest.h>

namespace heft {
namespace {

TEST(Quantile, InterpolatesBetweenOrderStatistics) {
  EXPECT_DOUBLE_EQ(*quantile({4, 1, 3, 2}, 0.5), 2.5);
  EXPECT_DOUBLE_EQ(*quantile({4, 1, 3, 2}, 0.25), 1.75);
  EXPECT_DOUBLE_EQ(*quantile({4, 1, 3, 2}, 1), 4);
  EXPECT_DOUBLE_EQ(*quantile({7}, 0.75), 7);
}

TEST(Quantile, OfNothingIsNone) {
  EXPECT_FALSE(quantile({}, 0.5).has_value());
}

}  // namespace
}  // namespace heft
