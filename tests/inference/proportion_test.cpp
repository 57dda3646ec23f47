// Percentages: which interval is used, and that participants have equal weight.
#include "inference/Proportion.h"

#include <gtest/gtest.h>

#include <array>
#include <boost/math/distributions/beta.hpp>
#include <cmath>
#include <iostream>

#include "Coverage.h"
#include "base/Random.h"

namespace heft {
namespace {

TEST(Proportion, ParticipantsCountAlikeWhateverTheirTrials) {
  const Proportion proportion = proportion_of({{"a", {1, 1}}, {"b", {0, 9}}});
  EXPECT_DOUBLE_EQ(*proportion.mean_percent, 50);
  EXPECT_DOUBLE_EQ(*proportion.pooled_percent, 10);
  EXPECT_DOUBLE_EQ(*proportion.sd_percent, std::sqrt(5000.0));
  EXPECT_EQ(proportion.n_participants, 2);
}

// Intervals by tests/golden/analysis/shares.R.
TEST(Proportion, DifferingParticipantsAreTheUnitOfTheInterval) {
  const Proportion high =
      proportion_of({{"a", {6, 10}}, {"b", {8, 10}}, {"c", {10, 10}}, {"d", {8, 10}}});
  EXPECT_EQ(high.method, IntervalMethod::participants);
  EXPECT_NEAR(high.interval_percent->low, 47.5580536882, 1e-8);
  EXPECT_NEAR(high.interval_percent->high, 94.6360830465, 1e-8);
  const Tallies few{{"a", {0, 5}}, {"b", {1, 5}}, {"c", {0, 5}}, {"d", {3, 5}}};
  EXPECT_NEAR(proportion_of(few).interval_percent->low, 2.48495580975, 1e-8);
  EXPECT_NEAR(proportion_of(few).interval_percent->high, 71.03661632427, 1e-8);
  EXPECT_NEAR(interval_percent_of(few, 0.9)->high, 60.64772052934, 1e-8);
}

TEST(Proportion, WhereAllAreTheSameTheIntervalIsExactOverPeople) {
  Tallies none, all;
  for (char name = 'a'; name < 'a' + 13; ++name) {
    none[{name}] = {0, 5};
    all[{name}] = {5, 5};
  }
  const double bound = 100 * (1 - std::pow(0.025, 1.0 / 13));  // not 65 trials
  EXPECT_EQ(proportion_of(none).method, IntervalMethod::exact);
  EXPECT_NEAR(proportion_of(none).interval_percent->high, bound, 1e-9);
  EXPECT_NEAR(proportion_of(all).interval_percent->low, 100 - bound, 1e-9);
  EXPECT_EQ(proportion_of(all).sd_percent, 0);
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

TEST(Rate, IsOfAllTrialsWithParticipantsAsClusters) {
  const Rate rate = rate_of({{"a", {5, 13}}, {"b", {0, 4}}, {"c", {3, 6}}, {"d", {0, 0}}});
  EXPECT_NEAR(*rate.percent, 800.0 / 23, 1e-12);
  EXPECT_EQ(rate.n_participants, 3);
  EXPECT_NEAR(rate.interval_percent->low, 11.0490321945, 1e-8);
  EXPECT_NEAR(rate.interval_percent->high, 69.6042987225, 1e-8);
  const Rate none = rate_of({{"a", {0, 13}}, {"b", {0, 4}}, {"c", {0, 6}}});
  EXPECT_NEAR(none.interval_percent->high, 70.7598226179, 1e-8);  // three people, not 23 trials
  EXPECT_FALSE(rate_of({}).percent.has_value());
}

// Eleven people, of whom one makes nearly all of the hits.
TEST(Proportion, WhereFewMakeTheSpreadTheIntervalIsWider) {
  constexpr std::array hits{0, 1, 0, 0, 4, 0, 0, 1, 0, 0, 0};
  constexpr std::array hits_of_many{0, 1, 0, 0, 7, 0, 0, 1, 0, 0, 0};
  Tallies equal, unequal;
  for (int i = 0; i < 11; ++i) {
    const auto at = static_cast<std::size_t>(i);
    equal[std::to_string(i)] = {hits[at], 5};
    unequal[std::to_string(i)] = {hits_of_many[at], i < 10 ? 5 + i : 20};
  }
  EXPECT_NEAR(proportion_of(equal).interval_percent->low, 1.10499897588, 1e-8);
  EXPECT_NEAR(proportion_of(equal).interval_percent->high, 57.29977789181, 1e-8);
  EXPECT_NEAR(rate_of(unequal).interval_percent->low, 0.552267724468, 1e-8);
  EXPECT_NEAR(rate_of(unequal).interval_percent->high, 56.486378928585, 1e-8);
}

TEST(Rate, OfPeopleIsExact) {
  EXPECT_NEAR(rate_of_people({5, 13}).interval_percent->high, 68.4222397085937, 1e-9);
  EXPECT_FALSE(rate_of_people({0, 0}).percent.has_value());
}

// People whose own shares are beta distributed around one, with that correlation between the trials
// of a person.
class OwnShares {
 public:
  OwnShares(double share, double correlation) {
    shares_.fill(share);
    if (correlation == 0) return;
    const double size = (1 - correlation) / correlation;
    const boost::math::beta_distribution<> people(share * size, (1 - share) * size);
    for (std::size_t i = 0; i < shares_.size(); ++i)
      shares_[i] =
          quantile(people, (static_cast<double>(i) + 0.5) / static_cast<double>(shares_.size()));
  }

  double draw(RandomStream& stream) const { return shares_[stream.below(shares_.size())]; }

 private:
  std::array<double, 5000> shares_{};
};

// Number of trials of each person.
enum class Trials { five, four_to_twelve, forty, one_to_twenty };

int n_trials(Trials trials, int person) {
  switch (trials) {
    case Trials::five:
      return 5;
    case Trials::four_to_twelve:
      return 4 + person % 9;
    case Trials::forty:
      return 40;
    case Trials::one_to_twenty:
      return 1 + person * person % 20;
  }
  return 0;
}

struct Shares {
  Coverage mean, ratio;
};

Shares coverage(int n_people, double share, double correlation, Trials trials) {
  RandomStream stream(3, "shares", static_cast<std::uint64_t>(n_people));
  const OwnShares people(share, correlation);
  Shares found;
  for (int study = 0; study < n_studies(100); ++study) {
    Tallies tallies;
    for (int i = 0; i < n_people; ++i) {
      const double own = people.draw(stream);
      Tally& tally = tallies[std::to_string(i)];
      tally.n_trials = n_trials(trials, i);
      for (int trial = 0; trial < tally.n_trials; ++trial) tally.n_hits += stream.coin(own) ? 1 : 0;
    }
    found.mean.add(proportion_of(tallies).interval_percent, 100 * share);
    found.ratio.add(rate_of(tallies).interval_percent, 100 * share);
  }
  return found;
}

TEST(CoverageOf, Shares) {
  const double chance = by_chance_percent(n_studies(100));
  for (int n_people : {13, 40})
    for (double correlation : {0.0, 0.1, 0.2})
      for (double share : {0.01, 0.03, 0.1, 0.2, 0.5, 0.8, 0.9, 0.97})
        for (const Trials trials :
             {Trials::five, Trials::four_to_twelve, Trials::forty, Trials::one_to_twenty}) {
          const Shares found = coverage(n_people, share, correlation, trials);
          std::cout << n_people << " people, correlation " << correlation << ", share " << share
                    << ", about " << n_trials(trials, 4) << " trials: " << found.mean.percent()
                    << " % (mean), " << found.ratio.percent() << " % (ratio)\n";
          const bool inside = share >= 0.1 && share <= 0.9;
          for (const Coverage& one : {found.mean, found.ratio}) {
            EXPECT_GE(one.percent(), 93 - chance) << n_people << " " << share;
            EXPECT_LE(one.percent(), (inside ? 98 : 100) + chance) << n_people << " " << share;
          }
        }
}

}  // namespace
}  // namespace heft
