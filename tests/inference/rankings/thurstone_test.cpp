// Perceived values from rank orders: against R and closed forms, what is not identifiable, and how
// often intervals contain the true value.
#include "inference/rankings/Thurstone.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>

#include "base/Random.h"
#include "inference/Coverage.h"
#include "psychophysics/ObserverModels.h"

namespace heft {
namespace {

using Eigen::VectorXd;
using testing::HasSubstr;

VectorXd values_of(const std::vector<double>& values) {
  return Eigen::Map<const VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

TEST(RankingProbability, OfTwoIsTheNormalDistribution) {
  for (const double distance : {-4.0, -1.0, 0.0, 0.3, 2.0}) {
    const double p = normal_cdf(distance);
    EXPECT_NEAR(std::exp(ranking_probability(values_of({1, 1 + distance})).log_p), p, 1e-6 * p);
  }
}

TEST(RankingProbability, OfEqualValuesIsOneOfTheOrders) {
  for (const Eigen::Index n : {2, 3, 4, 5, 6})
    EXPECT_NEAR(std::exp(ranking_probability(VectorXd::Constant(n, 7)).log_p) *
                    std::tgamma(static_cast<double>(n) + 1),
                1, 1e-6);
}

// R: two nested integrate().
TEST(RankingProbability, OfFourIsAsRIntegratesIt) {
  EXPECT_NEAR(ranking_probability(values_of({0.1, -0.4, 1.5, 0.9})).log_p, -2.6686074364, 1e-6);
}

TEST(RankingProbability, HasTheDerivativesOfItsValue) {
  const VectorXd values = values_of({0.1, -0.4, 1.5, 0.9, 3});
  const RankingProbability found = ranking_probability(values);
  constexpr double h = 1e-4;
  for (Eigen::Index j = 0; j < values.size(); ++j) {
    VectorXd above = values, below = values;
    above[j] += h;
    below[j] -= h;
    const RankingProbability more = ranking_probability(above), less = ranking_probability(below);
    EXPECT_NEAR(found.gradient[j], (more.log_p - less.log_p) / (2 * h), 1e-6);
    for (Eigen::Index k = 0; k < values.size(); ++k)
      EXPECT_NEAR(found.hessian(j, k), (more.gradient[k] - less.gradient[k]) / (2 * h), 1e-6);
  }
}

// R: optim() and uniroot() on the same likelihood by integrate(), Student's t of 81 degrees.
TEST(Thurstone, OfOnePersonIsAsRFindsIt) {
  const auto found = perceived_values({{"one",
                                        {{{15, 200, 800}, 41},
                                         {{15, 800, 200}, 17},
                                         {{200, 15, 800}, 13},
                                         {{200, 800, 15}, 5},
                                         {{800, 15, 200}, 4},
                                         {{800, 200, 15}, 2}}}});
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0].from_lowest.value, 0);
  EXPECT_NEAR(*found[1].from_lowest.value, 0.6546692292, 1e-5);
  EXPECT_NEAR(*found[2].from_lowest.value, 1.1887693162, 1e-5);
  EXPECT_NEAR(found[2].from_lowest.interval->low, 0.8890736287, 1e-5);
  EXPECT_NEAR(found[2].from_lowest.interval->high, 1.4976911997, 1e-5);
  EXPECT_NEAR(*found[2].from_previous.value, 0.5341000870, 1e-5);
  EXPECT_NEAR(found[2].from_previous.interval->low, 0.2621364395, 1e-5);
  EXPECT_NEAR(found[2].from_previous.interval->high, 0.8106995960, 1e-5);
}

// Six people who sort two cubes correctly in these numbers of five trials, each `times` as often.
OrdersByPerson pairs(int times) {
  OrdersByPerson people;
  for (const int n_correct : {5, 4, 3, 5, 2, 4}) {
    auto& own = people[std::to_string(people.size())];
    own[{100, 200}] = times * n_correct;
    if (n_correct < 5) own[{200, 100}] = times * (5 - n_correct);
  }
  return people;
}

// R: the closed forms of two cubes.
TEST(Thurstone, OfSeveralPeopleIsScaledToTheirVariance) {
  const PerceivedDistance found = perceived_values(pairs(1)).at(1).from_lowest;
  EXPECT_EQ(found.n, 6);
  EXPECT_NEAR(*found.value, 0.7279132908, 1e-5);
  EXPECT_NEAR(found.interval->low, -0.05246215417, 1e-5);
  EXPECT_NEAR(found.interval->high, 1.58823015332, 1e-5);
}

TEST(Thurstone, MoreTrialsOfTheSamePeopleSayNoMoreOfOthers) {
  const Interval few = *perceived_values(pairs(1)).at(1).from_lowest.interval;
  const Interval many = *perceived_values(pairs(9)).at(1).from_lowest.interval;
  EXPECT_NEAR(few.low, many.low, 1e-5);
  EXPECT_NEAR(few.high, many.high, 1e-5);
}

OrdersByPerson of_people(int n, const std::map<RankOrder, int>& orders) {
  OrdersByPerson people;
  for (int i = 0; i < n; ++i) people[std::to_string(i)] = orders;
  return people;
}

TEST(Thurstone, EqualPeopleHaveAnInterval) {
  const PerceivedDistance found =
      perceived_values(of_people(6, {{{1, 2}, 4}, {{2, 1}, 1}})).at(1).from_lowest;
  EXPECT_GT(found.interval->high - found.interval->low, 0.2);
}

TEST(Thurstone, WhatWasNeverExchangedHasNoDistance) {
  const auto found = perceived_values(of_people(6, {{{15, 200, 800}, 5}, {{15, 800, 200}, 2}}));
  EXPECT_FALSE(found[0].from_lowest.value);
  EXPECT_EQ(found[0].from_lowest.why, "no other has a distance to it");
  EXPECT_FALSE(found[1].from_lowest.value);
  EXPECT_FALSE(found[1].from_lowest.interval);
  EXPECT_EQ(found[1].from_lowest.why,
            "complete separation: 15 g was never ranked above 200 g, directly or by way of others, "
            "so that their distance has no bound");
  EXPECT_THAT(found[2].from_lowest.why, HasSubstr("15 g was never ranked above 800 g"));
  EXPECT_NEAR(*found[2].from_previous.value, normal_quantile(5.0 / 7), 1e-5);
  const auto inverted = perceived_values(of_people(6, {{{200, 15}, 5}}));
  EXPECT_THAT(inverted[1].from_lowest.why, HasSubstr("200 g was never ranked above 15 g"));
}

TEST(Thurstone, ChainsLinkWhatWasNeverTogether) {
  const std::map<RankOrder, int> low{{{1, 2}, 4}, {{2, 1}, 1}}, high{{{2, 3}, 4}, {{3, 2}, 1}};
  std::map<RankOrder, int> both = low;
  both.insert(high.begin(), high.end());
  const auto linked = perceived_values(of_people(6, both));
  EXPECT_NEAR(*linked[2].from_lowest.value, 2 * normal_quantile(0.8), 1e-5);
  both = low;
  both[{3, 4}] = both[{4, 3}] = 3;
  EXPECT_EQ(perceived_values(of_people(6, both))[2].from_lowest.why,
            "they were never ranked together, nor linked by others");
}

TEST(Thurstone, TooFewPeopleOrOrdersAreNamed) {
  const std::map<RankOrder, int> orders{{{1, 2}, 4}, {{2, 1}, 1}};
  EXPECT_THAT(perceived_values(of_people(4, orders))[1].from_lowest.why,
              HasSubstr("4 participants are too few"));
  EXPECT_TRUE(perceived_values(of_people(5, orders))[1].from_lowest.value);
  EXPECT_EQ(perceived_values(of_people(1, orders))[1].from_lowest.why,
            "5 rankings are too few, expected 10 or more");
  EXPECT_TRUE(perceived_values({}).empty());
}

TEST(Thurstone, WithoutTheOnlyPersonWhoLinksThemThereIsNone) {
  OrdersByPerson people = of_people(6, {{{1, 2}, 3}, {{2, 1}, 3}, {{3, 4}, 3}, {{4, 3}, 3}});
  people["0"][{2, 3}] = people["0"][{3, 2}] = 2;
  const auto found = perceived_values(people);
  EXPECT_EQ(found[2].from_lowest.why, "one participant's orders alone link them");
  EXPECT_FALSE(found[2].from_lowest.value);
}

std::map<RankOrder, int> sorted_by(double gain, int n_trials, const std::vector<double>& values,
                                   RandomStream& stream) {
  std::map<RankOrder, int> own;
  for (int t = 0; t < n_trials; ++t) {
    std::vector<std::pair<double, double>> percepts;
    for (const double value : values)
      percepts.emplace_back(gain * value + std::sqrt(0.5) * stream.normal(), value);
    std::ranges::sort(percepts);
    RankOrder order;
    for (const auto& [percept, value] : percepts) order.push_back(value);
    own[order] += 1;
  }
  return own;
}

// People whose sensitivities differ sort cubes several times.
OrdersByPerson sorted(int n_people, int n_trials, const std::vector<double>& values, double spread,
                      std::uint64_t seed) {
  RandomStream stream(seed, "sorting");
  OrdersByPerson people;
  for (int i = 0; i < n_people; ++i) {
    const double gain = std::exp(spread * stream.normal());
    people[std::to_string(i)] = sorted_by(gain, n_trials, values, stream);
  }
  return people;
}

// The true value is that of very many people.
TEST(CoverageOf, PerceivedMasses) {
  const int studies = n_studies(20);
  for (const double spread : {0.0, 0.3, 0.6})
    for (const double last : {0.8, 2.4}) {
      const std::vector<double> values{0, last / 3, last};
      const auto truth = perceived_values(sorted(5000, 10, values, spread, 1));
      for (const int n_people : {5, 13, 40}) {
        Coverage lowest, previous;
        double sum = 0;
        for (int i = 0; i < studies; ++i) {
          const auto seed = static_cast<std::uint64_t>(2 + i);
          const PerceivedStimulus found =
              perceived_values(sorted(n_people, 5, values, spread, seed)).back();
          lowest.add(found.from_lowest.interval, *truth.back().from_lowest.value);
          previous.add(found.from_previous.interval, *truth.back().from_previous.value);
          sum += found.from_lowest.value.value_or(0);
        }
        std::cout << n_people << " people, perceived mass " << last << ", spread " << spread << ": "
                  << lowest.percent() << " %; from the next lighter " << previous.percent()
                  << " %; of " << previous.given_percent() << " %; mean " << sum / lowest.n_given()
                  << " for " << *truth.back().from_lowest.value << "\n";
        for (const Coverage& coverage : {lowest, previous})
          EXPECT_GE(coverage.percent(), 93 - by_chance_percent(coverage.n_given()));
      }
    }
}

// The heaviest cube above the lightest one in two conditions, in which the same people sort: in the
// second it is perceived at `last` instead of 0.8.
std::array<PerceivedDistance, 2> in_two_conditions(int n_people, int n_trials, double last,
                                                   double spread, std::uint64_t seed) {
  RandomStream stream(seed, "two conditions");
  std::array<OrdersByPerson, 2> people;
  for (int i = 0; i < n_people; ++i) {
    const double gain = std::exp(spread * stream.normal());
    for (std::size_t k = 0; k < people.size(); ++k)
      people[k][std::to_string(i)] =
          sorted_by(gain, n_trials, {0, 0.4, k == 0 ? 0.8 : last}, stream);
  }
  return {perceived_values(people[0]).back().from_lowest,
          perceived_values(people[1]).back().from_lowest};
}

TEST(CoverageOf, PerceivedMassContrasts) {
  const int studies = n_studies(20);
  for (const double spread : {0.0, 0.6})
    for (const double last : {0.8, 1.6}) {
      const auto [first, second] = in_two_conditions(5000, 10, last, spread, 1);
      const double truth = *second.value - *first.value;
      for (const int n_people : {5, 13, 40}) {
        Coverage found;
        for (int i = 0; i < studies; ++i) {
          const auto [from, to] =
              in_two_conditions(n_people, 5, last, spread, static_cast<std::uint64_t>(2 + i));
          if (from.value && to.value) found.add(perceived_contrast(from, to).interval(), truth);
        }
        std::cout << n_people << " people, perceived masses 0.8 and " << last << ", spread "
                  << spread << ": " << found.percent() << " % of " << found.n_given() << "\n";
        EXPECT_GE(found.percent(), 93 - by_chance_percent(found.n_given()));
      }
    }
}

}  // namespace
}  // namespace heft
