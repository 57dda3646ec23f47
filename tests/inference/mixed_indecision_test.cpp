// Thresholds of several people: the true values are found, and where there is none the reason is
// right, for all together and for each person.
#include <gmock/gmock.h>

#include <cmath>

#include "base/Random.h"
#include "inference/MixedIndecision.h"
#include "inference/PopulationLikelihood.h"

namespace heft {
namespace {

using testing::HasSubstr;
using testing::StartsWith;
using People = std::map<std::string, AnswersByLevel>;

struct Observer {
  double threshold_75_g = 0;  // 0: feels nothing; below 0: answers go against the level
  double indecision = 1, lapse = 0.02;
};

const std::vector<double> levels_g{50, 100, 150, 200, 250, 300, 350, 400, 450, 500, 550, 600};

// Left, none, right by mass on the right minus mass on the left; the side is drawn.
AnswersByLevel answers_of(const Observer& observer, int n_per_level, RandomStream& stream) {
  AnswersByLevel answers;
  for (int i = 0; i < n_per_level; ++i)
    for (const double level_g : levels_g) {
      const double signed_g = stream.coin(0.5) ? level_g : -level_g;
      const double per_g = observer.threshold_75_g == 0 ? 0 : z_75 / observer.threshold_75_g;
      const double felt = per_g * signed_g + stream.normal();
      std::size_t answer = felt > observer.indecision ? 2 : felt < -observer.indecision ? 0 : 1;
      if (stream.coin(observer.lapse)) answer = stream.below(3);
      answers[signed_g][answer] += 1;
    }
  return answers;
}

People people_like(const Observer& observer, int n_people, int n_per_level = 5) {
  RandomStream stream(20261123, "people");
  People people;
  for (int i = 0; i < n_people; ++i)
    people["P" + std::to_string(10 + i)] = answers_of(observer, n_per_level, stream);
  return people;
}

std::vector<OwnThreshold> own_of(const People& people) {
  const MixedFit all = fit_mixed_indecision(people);
  std::vector<OwnThreshold> own;
  for (const auto& [name, answers] : people) {
    const auto found = all.people.find(name);
    own.push_back(own_threshold(answers, found == all.people.end() ? nullptr : &found->second));
  }
  return own;
}

// Tests one person, too few people to be pooled, and enough.
void expect_no_threshold(const Observer& observer, const std::string& reason) {
  for (const int n_people : {1, 6}) {
    const People people = people_like(observer, n_people, 10);
    const MixedFit found = fit_mixed_indecision(people);
    EXPECT_THAT(found.why, HasSubstr(reason)) << n_people;
    EXPECT_FALSE(found.threshold_75_g) << n_people;
  }
  for (const int n_people : {1, 3, 6})
    for (const OwnThreshold& own : own_of(people_like(observer, n_people, 10))) {
      EXPECT_THAT(own.why, HasSubstr(reason)) << n_people;
      EXPECT_FALSE(own.threshold_75_g || own.interval_g) << n_people;
    }
}

TEST(MixedIndecision, FindsWhatWasPutIn) {
  const MixedFit found = fit_mixed_indecision(people_like({200, 1.5}, 12, 10));
  ASSERT_TRUE(found.identifiable()) << found.why;
  EXPECT_NEAR(found.threshold_75_g->value, 200, 30);
  EXPECT_NEAR(found.indecision->value, 1.5, 0.2);
  EXPECT_LT(*found.threshold_75_g->low, 200);
  EXPECT_GT(*found.threshold_75_g->high, 200);
  EXPECT_LT(*found.indecision->low, 1.5);
  EXPECT_GT(*found.indecision->high, 1.5);
  EXPECT_LT(found.lapse->value, 0.06);
  for (const OwnThreshold& own : own_of(people_like({200, 1.5}, 12, 10))) {
    ASSERT_TRUE(own.threshold_75_g.has_value()) << own.why;
    EXPECT_LT(own.interval_g->low, *own.threshold_75_g);
    EXPECT_GT(own.interval_g->high, *own.threshold_75_g);
  }
}

TEST(NoThreshold, WhereNoCubeWasEverChosen) {
  expect_no_threshold({0, 1e9, 0}, "no cube was ever chosen");
  const MixedFit found = fit_mixed_indecision(people_like({0, 1e9, 0}, 6));
  EXPECT_FALSE(found.sensitivity || found.indecision);
}

// Criteria beyond all levels: the few choices are lapses.
TEST(NoThreshold, WhereTheLikelihoodIsFlat) {
  for (std::uint64_t seed = 0; seed < 10; ++seed)
    for (const int n_people : {2, 6, 13}) {
      People people;
      for (int i = 0; i < n_people; ++i) {
        AnswersByLevel& answers = people["P" + std::to_string(10 + i)];
        for (const double level_g : levels_g) answers[level_g][1] = answers[-level_g][1] = 2;
      }
      RandomStream stream(seed, "lapses");
      for (int i = 0; i < 2; ++i)
        people["P1" + std::to_string(i)][levels_g[stream.below(12)]] = {1.0 * i, 2, 1.0 - i};
      const MixedFit found = fit_mixed_indecision(people);
      EXPECT_THAT(found.why, StartsWith(n_people < least_people ? "2 participants are too few"
                                                                : "flat likelihood"));
      EXPECT_FALSE(found.sensitivity || found.indecision);
      for (const OwnThreshold& own : own_of(people)) EXPECT_NE(own.why, "");
    }
  AnswersByLevel one;
  for (const double level_g : levels_g) one[level_g][1] = one[-level_g][1] = 2;
  one[100] = {0, 1, 1};
  EXPECT_THAT(own_threshold(one, nullptr).why, StartsWith("flat likelihood"));
  EXPECT_THAT(fit_mixed_indecision({{"P1", one}}).why, StartsWith("flat likelihood"));
  const OwnSensitivity no_end{0.001};
  EXPECT_THAT(own_threshold(one, &no_end).why, StartsWith("flat likelihood"));
}

TEST(NoThreshold, WhereTheLevelsPartTheAnswers) {
  People people;
  for (int i = 0; i < 6; ++i)
    for (const double level_g : levels_g) {
      people["P" + std::to_string(i)][level_g][level_g > 320 ? 2 : 1] = 5;
      people["P" + std::to_string(i)][-level_g][level_g > 320 ? 0 : 1] = 5;
    }
  EXPECT_THAT(fit_mixed_indecision(people).why, StartsWith("separation"));
  for (const OwnThreshold& own : own_of(people)) EXPECT_THAT(own.why, StartsWith("separation"));
  people.erase(std::next(people.begin()), people.end());
  EXPECT_THAT(fit_mixed_indecision(people).why, StartsWith("separation"));
  EXPECT_THAT(own_of(people).at(0).why, StartsWith("separation"));
}

TEST(NoThreshold, WhereAnswersGoAgainstTheLevel) {
  expect_no_threshold({-150}, "negative sensitivity");
}

TEST(NoThreshold, WhereTheIntervalHoldsNone) {
  for (const int n_people : {1, 6})
    EXPECT_THAT(fit_mixed_indecision(people_like({0, 0.6}, n_people, 10)).why,
                StartsWith("no reliable sensitivity"));
  int n = 0;
  for (const OwnThreshold& own : own_of(people_like({0, 0.6}, 6, 10)))
    n += own.why.starts_with("no reliable sensitivity") ? 1 : 0;
  EXPECT_GE(n, 5);  // one in twenty intervals does not hold the truth
}

TEST(NoThreshold, WhereItsIntervalExceedsTheLevels) {
  EXPECT_THAT(fit_mixed_indecision(people_like({900, 0.6}, 6, 20)).why,
              HasSubstr("beyond twice the largest level shown"));
  const OwnSensitivity weak{0.001, 0.0001, 0.002};
  EXPECT_THAT(own_threshold(people_like({200}, 1).at("P10"), &weak).why,
              HasSubstr("reaches to 6745 g, beyond twice the largest level shown"));
  for (const OwnThreshold& own : own_of(people_like({1000, 0.6}, 1, 60)))
    EXPECT_THAT(own.why, HasSubstr("beyond twice the largest level shown"));
}

TEST(NoThreshold, OfTooFewPeopleOrTrials) {
  for (const int n_people : {2, 4})
    EXPECT_THAT(fit_mixed_indecision(people_like({150}, n_people)).why,
                StartsWith(std::to_string(n_people) + " participants are too few"));
  EXPECT_EQ(fit_mixed_indecision({}).why, "there are no trials");
  const People few{{"P1", {{-50, {1, 1, 0}}, {50, {0, 1, 2}}}}};
  EXPECT_THAT(fit_mixed_indecision(few).why, HasSubstr("5 trials are too few"));
  EXPECT_THAT(own_of(few).at(0).why, HasSubstr("5 trials are too few"));
  EXPECT_EQ(fit_mixed_indecision({{"P1", {{0, {5, 5, 5}}}}}).why, "no trial had a difference");
}

// What most samples of people hold says nothing.
TEST(MixedIndecision, OfOnePersonsChoicesAmongManyIsNone) {
  People people = people_like({150, 1, 0}, 1, 10);
  for (int i = 0; i < 5; ++i)
    for (const double level_g : levels_g)
      people["Q" + std::to_string(i)][level_g][1] = people["Q" + std::to_string(i)][-level_g][1] =
          5;
  const MixedFit found = fit_mixed_indecision(people);
  EXPECT_FALSE(found.threshold_75_g.has_value());
  EXPECT_NE(found.why, "");
}

// Otherwise the search for a profile's end at a bound might not terminate.
TEST(PopulationLikelihood, WhatIsHeldStaysToTheBit) {
  std::vector<std::vector<LevelAnswers>> people;
  for (const auto& [name, answers] : people_like({200, 0}, 3)) {
    people.emplace_back();
    for (const auto& [level_g, n] : answers) people.back().push_back({level_g / 600, n});
  }
  PopulationLikelihood likelihood(people);
  RandomStream stream(20261128, "starts");
  for (int i = 0; i < 100; ++i) {
    Parameters from(n_population_parameters);
    for (Eigen::Index k = 0; k < n_population_parameters; ++k) {
      const ParameterBounds& bounds = likelihood.bounds()[static_cast<std::size_t>(k)];
      from[k] = bounds.low + stream.uniform() * (bounds.high - bounds.low);
    }
    const Eigen::Index held = i % n_population_parameters;
    EXPECT_EQ(likelihood.climb(from, held).at[held], from[held]) << "start " << i;
  }
}

}  // namespace
}  // namespace heft
