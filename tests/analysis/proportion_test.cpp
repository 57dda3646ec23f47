// Percentages: which interval is used when, and that participants count alike.
#include "analysis/Proportion.h"

#include <gtest/gtest.h>

#include <cmath>

namespace heft {
namespace {

TEST(Proportion, ParticipantsCountAlikeWhateverTheirTrials) {
  const Proportion proportion = proportion_of({{"a", {1, 1}}, {"b", {0, 9}}});
  EXPECT_DOUBLE_EQ(*proportion.mean_percent, 50);
  EXPECT_DOUBLE_EQ(*proportion.pooled_percent, 10);
  EXPECT_DOUBLE_EQ(*proportion.sd_percent, std::sqrt(5000.0));
  EXPECT_EQ(proportion.n_participants, 2);
}

TEST(Proportion, DifferingParticipantsGetAStudentInterval) {
  const Proportion proportion =
      proportion_of({{"a", {3, 5}}, {"b", {4, 5}}, {"c", {5, 5}}, {"d", {4, 5}}});
  EXPECT_EQ(proportion.method, IntervalMethod::student_t);
  EXPECT_NEAR(proportion.interval_percent->low, 54.0154347274978, 1e-9);
  EXPECT_EQ(proportion.interval_percent->high, 100);  // 105.98 is no percentage
}

TEST(Proportion, StudentIntervalIsClippedBelow) {
  const Proportion proportion = proportion_of({{"a", {1, 10}}, {"b", {2, 10}}, {"c", {3, 10}}});
  EXPECT_EQ(proportion.interval_percent->low, 0);  // -4.84
  EXPECT_NEAR(proportion.interval_percent->high, 44.8413771175033, 1e-9);
}

TEST(Proportion, AllAtZeroOrHundredGetAnExactIntervalOverPooledTrials) {
  Tallies nobody, everybody;
  for (char name = 'a'; name < 'a' + 13; ++name) {
    nobody[{name}] = {0, 5};
    everybody[{name}] = {5, 5};
  }
  const double bound = 100 * (1 - std::pow(0.025, 1.0 / 65));
  EXPECT_EQ(proportion_of(nobody).method, IntervalMethod::exact);
  EXPECT_NEAR(proportion_of(nobody).interval_percent->high, bound, 1e-9);
  EXPECT_NEAR(proportion_of(everybody).interval_percent->low, 100 - bound, 1e-9);
  EXPECT_EQ(proportion_of(everybody).sd_percent, 0);
}

TEST(Proportion, OneParticipantHasNoSpreadAndAnExactInterval) {
  const Proportion proportion = proportion_of({{"a", {1, 5}}});
  EXPECT_FALSE(proportion.sd_percent.has_value());
  EXPECT_EQ(proportion.method, IntervalMethod::exact);
  EXPECT_NEAR(proportion.interval_percent->low, 0.505076337946806, 1e-9);
  EXPECT_NEAR(proportion.interval_percent->high, 71.641793611809, 1e-9);
}

TEST(Proportion, ParticipantsWithoutTrialsDoNotCount) {
  EXPECT_EQ(proportion_of({{"a", {1, 2}}, {"b", {0, 0}}}).n_participants, 1);
  EXPECT_FALSE(proportion_of({{"b", {0, 0}}}).mean_percent.has_value());
}

TEST(Rate, IsPooledWithAnExactInterval) {
  const Rate rate = rate_of({5, 13});
  EXPECT_NEAR(*rate.percent, 500.0 / 13, 1e-12);
  EXPECT_NEAR(rate.interval_percent->high, 68.4222397085937, 1e-9);
  EXPECT_FALSE(rate_of({0, 0}).percent.has_value());
}

}  // namespace
}  // namespace heft
