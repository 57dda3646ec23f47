// The Tobit and the log-normal mean: agreement with R, and coverage of their intervals.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <vector>

#include "Coverage.h"
#include "base/Random.h"
#include "inference/CensoredMean.h"

namespace heft {
namespace {

std::vector<CensoredValue> censored_on_both_sides() {
  std::vector<CensoredValue> values;
  for (double value : {212., 305., 148., 402., 267., 331., 190.}) values.push_back({value});
  values.push_back({500, Censored::above});
  values.push_back({500, Censored::above});
  values.push_back({15, Censored::below});
  return values;
}

TEST(CensoredMean, IsThatOfR) {  // tests/golden/analysis/tobit.R
  const auto found = censored_mean(censored_on_both_sides());
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

void expect_log_normal(const std::vector<CensoredValue>& values, CensoredMean expected) {
  const auto found = censored_mean(values, 0, FigureModel::log_normal);
  ASSERT_TRUE(found.has_value());
  EXPECT_NEAR(found->mean / expected.mean, 1, 1e-5);
  EXPECT_NEAR(found->sd / expected.sd, 1, 1e-5);
  EXPECT_NEAR(found->interval.low / expected.interval.low, 1, 1e-5);
  EXPECT_NEAR(found->interval.high / expected.interval.high, 1, 1e-5);
}

TEST(LogNormalMean, IsThatOfR) {  // tests/golden/analysis/tobit.R
  expect_log_normal(censored_on_both_sides(),
                    {579.951624964, 1392.640605866, {206.573877010, 24667.509786411}});
  expect_log_normal({{60}, {80}, {100}, {80}},
                    {80.0243613037, 16.9403585679, {59.9821929130, 119.5939855312}});
}

TEST(LogNormalMean, HasAPositiveInterval) {
  const std::vector<CensoredValue> values{{5},  {12}, {80}, {20},
                                          {30}, {8},  {60}, {2, Censored::below}};
  EXPECT_LT(censored_mean(values)->interval.low, 0) << "the normal model";
  const auto found = censored_mean(values, 0, FigureModel::log_normal);
  EXPECT_GT(found->interval.low, 0);
  EXPECT_LT(found->interval.low, found->mean);
  EXPECT_GT(found->interval.high, found->mean);
}

TEST(LogNormalMean, ZeroCountsAsBelowTheSmallestPositiveValue) {
  const auto zero =
      censored_mean(std::vector<CensoredValue>{{10}, {20}, {40}, {0}}, 0, FigureModel::log_normal);
  const auto below =
      censored_mean(std::vector<CensoredValue>{{10}, {20}, {40}, {10, Censored::below}}, 0,
                    FigureModel::log_normal);
  ASSERT_TRUE(zero && below);
  EXPECT_EQ(zero->mean, below->mean);
  const std::vector<CensoredValue> mostly_zero{{10}, {20}, {40}, {0}, {0}, {0}};
  EXPECT_FALSE(censored_mean(mostly_zero, 0, FigureModel::log_normal));
  const FigureSummary plain = summarize_figures(mostly_zero, 0, FigureModel::log_normal);
  EXPECT_EQ(plain.kind, MeanKind::mean);
  EXPECT_NEAR(*plain.mean, 70.0 / 6, 1e-12);
  EXPECT_FALSE(plain.interval);
}

TEST(LogNormalMean, NeedsThreeExactValues) {
  const std::vector<CensoredValue> two{{10}, {20}}, two_and_one{{10}, {20}, {5, Censored::below}};
  const FigureSummary plain = summarize_figures(two, 0, FigureModel::log_normal);
  EXPECT_EQ(plain.kind, MeanKind::mean);
  EXPECT_EQ(plain.mean, 15);
  EXPECT_FALSE(plain.interval);
  EXPECT_EQ(summarize_figures(two_and_one, 0, FigureModel::log_normal).kind, MeanKind::none);
  const std::vector<CensoredValue> three{{10}, {20}, {30}};
  EXPECT_EQ(summarize_figures(three, 0, FigureModel::log_normal).kind, MeanKind::log_normal_mean);
  EXPECT_EQ(summarize_figures(three, 3, FigureModel::log_normal).kind, MeanKind::none);
}

TEST(LogNormalMean, IsFinite) {
  const std::vector<CensoredValue> values{{1e-300}, {1}, {1e300}};
  EXPECT_FALSE(censored_mean(values, 0, FigureModel::log_normal));
}

TEST(LogNormalMean, IsNoneWhereItsIntervalHasHardlyALimit) {
  std::vector<CensoredValue> values{{21.9}, {32.1}, {36.9}, {26.7}};
  EXPECT_TRUE(censored_mean(values, 0, FigureModel::log_normal).has_value());
  values.push_back({244.1, Censored::above});
  values.push_back({201.1, Censored::above});
  EXPECT_FALSE(censored_mean(values, 0, FigureModel::log_normal).has_value())
      << "else 200 [43, 256141738]";
}

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

// Of the mean of standard normal figures, censored at a ceiling.
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

struct Cut {
  const char* name;
  double floor_sd, ceiling_sd;  // of the logarithms, in SD from their mean
};

// Of the mean of log-normal figures with a median of 1, censored at `cut`.
Coverage log_normal_coverage(int n_people, double log_sd, const Cut& cut) {
  RandomStream stream(8, cut.name, static_cast<std::uint64_t>(n_people));
  Coverage found;
  for (int study = 0; study < n_studies(200); ++study) {
    std::vector<CensoredValue> values;
    for (int i = 0; i < n_people; ++i) {
      const double z = stream.normal();
      const double shown = std::clamp(z, cut.floor_sd, cut.ceiling_sd);
      values.push_back({std::exp(log_sd * shown), shown < z   ? Censored::above
                                                  : shown > z ? Censored::below
                                                              : Censored::none});
    }
    const auto mean = censored_mean(values, 0, FigureModel::log_normal);
    found.add(mean ? std::optional(mean->interval) : std::nullopt, std::exp(log_sd * log_sd / 2));
  }
  return found;
}

TEST(CoverageOf, TheLogNormalMean) {
  for (int n_people : {5, 13, 40})
    for (double log_sd : {0.3, 0.6, 0.9})
      for (const Cut& cut :
           {Cut{"none", -9, 9}, Cut{"15 % below", -1.0364, 9}, Cut{"30 % below", -0.5244, 9},
            Cut{"15 % above", -9, 1.0364}, Cut{"30 % above", -9, 0.5244},
            Cut{"15 % on each side", -1.0364, 1.0364}}) {
        const Coverage found = log_normal_coverage(n_people, log_sd, cut);
        const double chance = by_chance_percent(found.n_given());
        std::cout << n_people << " people, log SD " << log_sd << ", " << cut.name
                  << " censored: " << found.percent() << " % of " << found.given_percent()
                  << " % given\n";
        EXPECT_GE(found.percent(), 94 - chance) << n_people << ' ' << log_sd << ' ' << cut.name;
        EXPECT_LE(found.percent(), 97 + chance) << n_people << ' ' << log_sd << ' ' << cut.name;
      }
}

}  // namespace
}  // namespace heft
