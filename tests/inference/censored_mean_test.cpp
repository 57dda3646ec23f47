// The Tobit mean: R's figures, and how often its interval holds the mean.
#include <gtest/gtest.h>

#include <iostream>
#include <vector>

#include "Coverage.h"
#include "base/Random.h"
#include "inference/CensoredMean.h"

namespace heft {
namespace {

TEST(CensoredMean, IsThatOfR) {  // tests/golden/analysis/tobit.R
  std::vector<CensoredValue> values;
  for (double value : {212., 305., 148., 402., 267., 331., 190.}) values.push_back({value});
  values.push_back({500, Censored::above});
  values.push_back({500, Censored::above});
  values.push_back({15, Censored::below});
  const auto found = censored_mean(values);
  ASSERT_TRUE(found.has_value());
  EXPECT_NEAR(found->mean, 299.090870839, 1e-3);
  EXPECT_NEAR(found->sd, 212.704531738, 1e-3);
  EXPECT_NEAR(found->interval.low, 126.216786972, 1e-3);
  EXPECT_NEAR(found->interval.high, 489.942572269, 1e-3);
}

TEST(CensoredMean, WithoutCensoringIsStudents) {
  const std::vector<CensoredValue> values{{60}, {80}, {100}, {80}};
  const auto found = censored_mean(values);
  EXPECT_DOUBLE_EQ(found->mean, 80);
  EXPECT_NEAR(found->interval.high, 105.984565272502, 1e-9);
}

TEST(CensoredMean, NeedsMoreThanHalfToBeExact) {
  const std::vector<CensoredValue> values{{1}, {2}, {4}, {9, Censored::above}};
  EXPECT_TRUE(censored_mean(values).has_value());
  EXPECT_TRUE(censored_mean(values, 1).has_value());
  EXPECT_FALSE(censored_mean(values, 2).has_value());
}

// Of normal figures that a bound cuts.
TEST(MeanFigure, IsKnownOnTheSideOnWhichItsPartsAre) {
  const std::optional<CensoredValue> exact{{10, Censored::none}}, above{{20, Censored::above}},
      below{{30, Censored::below}};
  const auto mean_of = [](std::vector<std::optional<CensoredValue>> parts) {
    return mean_figure(parts);
  };
  EXPECT_EQ(mean_of({exact, exact})->censored, Censored::none);
  EXPECT_EQ(mean_of({exact, above})->value, 15);
  EXPECT_EQ(mean_of({exact, above})->censored, Censored::above);
  EXPECT_EQ(mean_of({above, above})->censored, Censored::above);
  EXPECT_EQ(mean_of({below, exact, below})->censored, Censored::below);
  EXPECT_FALSE(mean_of({above, below}));
  EXPECT_FALSE(mean_of({exact, std::nullopt}));
  EXPECT_FALSE(mean_of({}));
  EXPECT_EQ(difference(exact, above)->value, -10);
  EXPECT_EQ(difference(exact, above)->censored, Censored::below) << "less than 10 - 20";
  EXPECT_EQ(difference(above, below)->censored, Censored::above);
  EXPECT_FALSE(difference(above, above));
}

Coverage coverage(int n_people, double ceiling_sd) {
  RandomStream stream(7, "studies", static_cast<std::uint64_t>(n_people));
  Coverage found;
  for (int study = 0; study < n_studies(500); ++study) {
    std::vector<CensoredValue> values;
    for (int i = 0; i < n_people; ++i) {
      const double value = stream.normal();
      values.push_back(
          {std::min(value, ceiling_sd), value > ceiling_sd ? Censored::above : Censored::none});
    }
    const auto mean = censored_mean(values);
    found.add(mean ? std::optional(mean->interval) : std::nullopt, 0);
  }
  return found;
}

TEST(CoverageOf, TheTobitMean) {
  for (int n_people : {13, 40})
    for (double ceiling_sd : {0.5, 1.0, 3.0}) {  // 31, 16 and 0.1 % censored
      const Coverage found = coverage(n_people, ceiling_sd);
      const double chance = by_chance_percent(found.n_given());
      std::cout << n_people << " people, ceiling at " << ceiling_sd << " SD: " << found.percent()
                << " % of " << found.given_percent() << " % given\n";
      EXPECT_GE(found.percent(), 94 - chance) << n_people << " people, ceiling " << ceiling_sd;
      EXPECT_LE(found.percent(), 97 + chance) << n_people << " people, ceiling " << ceiling_sd;
    }
}

}  // namespace
}  // namespace heft
