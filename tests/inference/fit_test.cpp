// Fits of simulated people: estimates, coverage of intervals, and no values where the data do not
// determine them. Against other programs: tests/golden/fit.
#include "inference/Fit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <string_view>

#include "Coverage.h"
#include "base/Random.h"

namespace heft {
namespace {

using testing::HasSubstr;

struct Person {
  PsychometricFunction function{};
  PsychometricParameters parameters{};
};

AnswersByLevel answers_of(const Person& person, const std::vector<double>& levels, int n_per_level,
                          RandomStream& random) {
  AnswersByLevel answers;
  for (const double level : levels)
    for (int i = 0; i < n_per_level; ++i)
      ++answers[level][random.coin(probability(person.function, person.parameters, level))];
  return answers;
}

AnswersByLevel choices_of(const IndecisionParameters& person, const std::vector<double>& levels,
                          int n_per_level, RandomStream& random) {
  AnswersByLevel answers;
  for (const double level : levels) {
    const IndecisionShares p = indecision_shares(person, level);
    for (int i = 0; i < n_per_level; ++i) {
      const double u = random.uniform();
      ++answers[level][u < p.reference ? 0 : u < p.reference + p.none ? 1 : 2];
    }
  }
  return answers;
}

const std::vector<double> seven{1, 2, 3, 4, 5, 6, 7};
const std::vector<double> compared_g{0, 50, 100, 150, 200, 300};

// In how many of 100 samples the 95 % interval of a parameter contains the true value.
Interval interval_of(const FittedParameter& fitted) {
  constexpr double open_end = std::numeric_limits<double>::infinity();
  return {fitted.low.value_or(-open_end), fitted.high.value_or(open_end)};
}

void expect_to_hold(const Person& person, const FitOptions& options) {
  Coverage threshold, slope;
  RandomStream random(7, "coverage");
  int n_identifiable = 0;
  for (int i = 0; i < 1000; ++i) {
    const Fit fit = fit_psychometric(answers_of(person, seven, 40, random), options);
    if (!fit.identifiable()) continue;
    ++n_identifiable;
    threshold.add(interval_of(fit.parameter("threshold")), person.parameters.threshold);
    slope.add(interval_of(fit.parameter("slope")), person.parameters.slope);
  }
  EXPECT_GT(n_identifiable, 850);
  for (const Coverage& coverage : {threshold, slope}) {
    EXPECT_GE(coverage.percent(), 93);
    EXPECT_LE(coverage.percent(), 98);
  }
}

TEST(PsychometricFit, IntervalsHoldTheTruthAsOftenAsTheySay) {
  expect_to_hold({{PsychometricShape::cumulative_normal, {}}, {4, 1.5, 0, 0}}, {});
  FitOptions forced_choice{{PsychometricShape::weibull, {}}, 0.5, 0.02};
  expect_to_hold({forced_choice.function, {3.5, 3, 0.5, 0.02}}, forced_choice);
  FitOptions free{{PsychometricShape::logistic, {}}, 0, std::nullopt};
  expect_to_hold({free.function, {3.5, 0.8, 0, 0.05}}, free);
}

TEST(IndecisionFit, IntervalsHoldTheTruthAsOftenAsTheySay) {
  const IndecisionParameters person{0.012, 0.8, 0.1, 0.02};
  const FitOptions options{{}, 0, 0.02};
  Coverage sensitivity, indecision, bias, threshold;
  RandomStream random(8, "coverage");
  for (int i = 0; i < 1000; ++i) {
    const Fit fit = fit_indecision(choices_of(person, compared_g, 20, random), options);
    if (!fit.identifiable()) continue;
    sensitivity.add(interval_of(fit.parameter("sensitivity")), person.sensitivity);
    indecision.add(interval_of(fit.parameter("indecision")), person.indecision);
    bias.add(interval_of(fit.parameter("bias")), person.bias);
    threshold.add(interval_of(fit.parameter("threshold_75_g")), 0.6745 / person.sensitivity);
  }
  for (const Coverage& coverage : {sensitivity, indecision, bias, threshold}) {
    EXPECT_GE(coverage.percent(), 93);
    EXPECT_LE(coverage.percent(), 98);
  }
}

// In how many of 100 samples coin flips have a threshold, with few and many trials.
double coins_with_a_threshold(double share, const FitOptions& options) {
  constexpr int n_coins = 300;
  constexpr std::array n_per_level{3, 10, 40};
  RandomStream random(9, "coin");
  int n = 0;
  for (std::size_t i = 0; i < n_coins; ++i) {
    AnswersByLevel answers;
    for (const double level : seven)
      for (int k = 0; k < n_per_level[i % 3]; ++k) ++answers[level][random.coin(share)];
    const Fit fit = fit_psychometric(answers, options);
    EXPECT_EQ(fit.identifiable(), fit.parameter("threshold").value.has_value());
    n += fit.identifiable();
  }
  return 100.0 * n / n_coins;
}

TEST(PsychometricFit, ACoinHasNoThreshold) {
  EXPECT_LE(coins_with_a_threshold(0.5, {}), 5);
  EXPECT_LE(coins_with_a_threshold(0.2, {}), 5);
  EXPECT_LE(coins_with_a_threshold(0.5, {{}, 0.5, 0.02}), 5);
  EXPECT_LE(coins_with_a_threshold(0.5, {{}, 0.5, std::nullopt}), 5);
  EXPECT_LE(coins_with_a_threshold(0.4, {{}, std::nullopt, std::nullopt}), 5);
}

TEST(IndecisionFit, ACoinHasNoThreshold) {
  RandomStream random(10, "coin");
  int n = 0;
  for (int i = 0; i < 300; ++i) {
    const double indecision = i % 3 * 0.5;
    const FitOptions options{{}, 0, i % 2 == 0 ? std::optional(0.02) : std::nullopt};
    n += fit_indecision(choices_of({0, indecision, 0.2, 0}, compared_g, 10, random), options)
             .identifiable();
  }
  EXPECT_LE(n, 15);
}

// Few trials often leave the sensitivity without an upper bound, though the best one is finite.
TEST(IndecisionFit, AThresholdHasAnIntervalAboveZero) {
  RandomStream random(11, "few trials");
  int n_unbounded = 0;
  for (int i = 0; i < 200; ++i) {
    const Fit fit =
        fit_indecision(choices_of({0.02, 0.5, 0, 0.02}, compared_g, 3, random), {{}, 0, 0.02});
    const FittedParameter& sensitivity = fit.parameter("sensitivity");
    EXPECT_TRUE(!fit.identifiable() || fit.parameter("threshold_75_g").low.value_or(0) > 0);
    if (!sensitivity.value || sensitivity.high || sensitivity.low.value_or(0) <= 0) continue;
    n_unbounded += 1;
    EXPECT_THAT(fit.why, HasSubstr("any large sensitivity fits within 95 %"));
  }
  EXPECT_GT(n_unbounded, 5);
}

std::string why_not(const AnswersByLevel& answers, const FitOptions& options = {}) {
  const Fit fit = fit_psychometric(answers, options);
  EXPECT_EQ(fit.parameter("threshold").value, std::nullopt);
  EXPECT_EQ(fit.parameter("slope").low, std::nullopt);
  return fit.why;
}

TEST(PsychometricFit, SaysWhyThereIsNoThreshold) {
  EXPECT_THAT(why_not({}), HasSubstr("no trials"));
  EXPECT_THAT(why_not({{1, {0, 20, 0}}, {2, {0, 20, 0}}}), HasSubstr("all answers are the same"));
  EXPECT_THAT(why_not({{1, {20, 0, 0}}, {2, {20, 0, 0}}}), HasSubstr("all answers are the same"));
  EXPECT_THAT(why_not({{3, {10, 10, 0}}}), HasSubstr("one level, 3"));
  EXPECT_THAT(why_not({{1, {2, 1, 0}}, {2, {1, 2, 0}}}), HasSubstr("too few"));
  EXPECT_THAT(why_not({{1, {10, 10, 0}}, {2, {11, 9, 0}}, {3, {9, 11, 0}}}),
              HasSubstr("no reliable slope"));
  EXPECT_THAT(why_not({{1, {2, 18, 0}}, {2, {10, 10, 0}}, {3, {18, 2, 0}}}),
              HasSubstr("no reliable slope"));
  EXPECT_THAT(why_not({{1, {20, 0, 0}}, {2, {20, 0, 0}}, {3, {0, 20, 0}}}),
              HasSubstr("separation"));
  EXPECT_THAT(why_not({{1, {20, 0, 0}}, {2, {8, 12, 0}}, {3, {0, 20, 0}}}),
              HasSubstr("separation"));
  EXPECT_THAT(why_not({{1, {98, 2, 0}}, {2, {90, 10, 0}}, {3, {80, 20, 0}}}),
              HasSubstr("beyond the levels"));
  const PsychometricFunction weibull{PsychometricShape::weibull, LevelScale::linear};
  EXPECT_THAT(why_not({{0, {19, 1, 0}}, {1, {8, 12, 0}}, {2, {1, 19, 0}}}, {weibull, 0, 0}),
              HasSubstr("positive answers at 0"));
  const AnswersByLevel seen_at_0{{0, {19, 1, 0}}, {1, {8, 12, 0}}, {2, {1, 19, 0}}};
  EXPECT_THAT(fit_psychometric(seen_at_0, {weibull, std::nullopt, 0}).why, Not(HasSubstr("at 0")))
      << "it may be a guess";
  EXPECT_TRUE(fit_psychometric(seen_at_0, {{PsychometricShape::logistic, {}}, 0, 0}).identifiable())
      << "its curve is above 0 everywhere";
}

TEST(PsychometricFit, ALogLikelihoodThatExistsIsGivenEvenWithoutAThreshold) {
  const Fit separated = fit_psychometric({{1, {20, 0, 0}}, {2, {8, 12, 0}}, {3, {0, 20, 0}}}, {});
  EXPECT_NEAR(*separated.log_likelihood, 8 * std::log(0.4) + 12 * std::log(0.6), 1e-9);
  const Fit coin = fit_psychometric({{1, {9, 11, 0}}, {2, {11, 9, 0}}}, {});
  EXPECT_NEAR(*coin.log_likelihood, 40 * std::log(0.5), 1e-9);
}

std::string why_no_choice(const AnswersByLevel& answers) {
  const Fit fit = fit_indecision(answers, {});
  EXPECT_EQ(fit.parameter("threshold_75_g").value, std::nullopt);
  return fit.why;
}

// Guesses and lapses leave each answer at least so much, also the one that was never given.
TEST(Steps, LeaveEachAnswerItsLeast) {
  EXPECT_NEAR(log_likelihood_of_steps({{1, {1, 0, 0}}}, std::array{0.1, 0.1}), std::log(0.9),
              1e-12);
  EXPECT_NEAR(log_likelihood_of_steps({{1, {2, 2, 0}}}, std::array{0.1, 0.1}), 4 * std::log(0.5),
              1e-12);
  EXPECT_NEAR(log_likelihood_of_steps({{1, {9, 0, 0}}, {2, {0, 5, 0}}}, std::array{0.0, 0.0}), 0,
              1e-12);
}

TEST(IndecisionFit, SaysWhyThereIsNoThreshold) {
  EXPECT_THAT(why_no_choice({}), HasSubstr("no trials"));
  EXPECT_THAT(why_no_choice({{0, {0, 9, 0}}, {90, {0, 9, 0}}}), HasSubstr("no cube was ever"));
  EXPECT_THAT(why_no_choice({{0, {9, 0, 0}}, {90, {9, 0, 0}}}), HasSubstr("all answers"));
  EXPECT_THAT(why_no_choice({{50, {5, 5, 5}}}), HasSubstr("one level"));
  EXPECT_THAT(why_no_choice({{-50, {10, 0, 0}}, {0, {0, 9, 0}}, {50, {0, 0, 10}}}),
              HasSubstr("separation"));
  EXPECT_THAT(why_no_choice({{50, {8, 5, 8}}, {100, {8, 5, 7}}}), HasSubstr("contains 0"));
  EXPECT_THAT(why_no_choice({{50, {5, 9, 5}}, {500, {25, 5, 1}}}), HasSubstr("negative"));
  EXPECT_THAT(why_no_choice({{0, {40, 40, 40}}, {100, {25, 40, 55}}}), HasSubstr("beyond twice"));
}

// 20 g apart, nothing is known of a threshold of hundreds of grams, whatever the reference weighs.
TEST(IndecisionFit, AbsoluteMassesReachNoFartherThanTheirRange) {
  const AnswersByLevel apart{{-10, {60, 40, 40}}, {10, {40, 40, 60}}};
  AnswersByLevel masses;
  for (const auto& [level_g, n] : apart) masses[level_g + 1000] = n;
  EXPECT_THAT(why_no_choice(apart), HasSubstr("beyond twice the largest level"));
  EXPECT_THAT(why_no_choice(masses), HasSubstr("beyond twice the range of levels"));
}

TEST(PsychometricFit, OfVeryManyLevelsIsThatOfTheSameAnswersOnFewer) {
  AnswersByLevel many, few;
  for (int i = 0; i < 6000; ++i) {
    const double level = i % 60 - 30,
                 share = standard_curve(PsychometricShape::cumulative_normal, level / 10).below;
    const int person = i / 60;
    const bool positive = person < 100 * share;
    many[level + 1e-9 * person][positive ? 1 : 0] += 1;
    few[level][positive ? 1 : 0] += 1;
  }
  const Fit fine = fit_psychometric(many, {}), coarse = fit_psychometric(few, {});
  ASSERT_EQ(fine.n_levels, 6000);
  for (const char* name : {"threshold", "slope"}) {
    EXPECT_NEAR(*fine.parameter(name).value, *coarse.parameter(name).value, 1e-5);
    EXPECT_NEAR(*fine.parameter(name).low, *coarse.parameter(name).low, 1e-4);
    EXPECT_NEAR(*fine.parameter(name).high, *coarse.parameter(name).high, 1e-4);
  }
}

// R's ordinal::clm and SciPy find 0.003653: on the way there the indecision seems to go below 0.
TEST(IndecisionFit, AnEndIsFoundWhereTheOthersTurnBack) {
  const Fit fit = fit_indecision({{-199.3, {1, 1, 0}},
                                  {-150.3, {2, 0, 0}},
                                  {-147.8, {0, 2, 0}},
                                  {-90.3, {0, 1, 0}},
                                  {36.8, {0, 2, 0}},
                                  {133.5, {0, 1, 0}},
                                  {271.5, {0, 0, 2}},
                                  {292.5, {0, 2, 2}}},
                                 {});
  EXPECT_NEAR(*fit.parameter("sensitivity").value, 0.01263953, 1e-7);
  EXPECT_NEAR(*fit.parameter("sensitivity").low, 0.003653, 3e-6);
}

TEST(IndecisionFit, WhatDoesNotExistIsNotGivenWhileSensitivityIs) {
  // The reference was never chosen, so its criterion is not identifiable.
  const Fit fit = fit_indecision({{50, {0, 30, 10}}, {100, {0, 20, 20}}, {200, {0, 5, 35}}}, {});
  EXPECT_TRUE(fit.identifiable()) << fit.why;
  EXPECT_EQ(fit.parameter("indecision").value, std::nullopt);
  EXPECT_EQ(fit.parameter("bias").value, std::nullopt);
  EXPECT_GT(fit.parameter("sensitivity").value, 0.005);
}

// Other units, or levels from another origin, give the same fit.
RC_GTEST_PROP(PsychometricFit, UnitsAndOriginDoNotMatter, ()) {
  RandomStream random(*rc::gen::arbitrary<std::uint32_t>(), "units");
  const Person person{{PsychometricShape::logistic, {}}, {4, 0.7, 0, 0}};
  const AnswersByLevel answers = answers_of(person, seven, 15, random);
  AnswersByLevel moved;
  for (const auto& [level, n] : answers) moved[1000 * level - 300] = n;
  const Fit here = fit_psychometric(answers, {person.function, 0, 0});
  const Fit there = fit_psychometric(moved, {person.function, 0, 0});
  RC_ASSERT(here.identifiable() == there.identifiable());
  RC_ASSERT(std::abs(*here.log_likelihood - *there.log_likelihood) < 1e-9);
  if (!here.identifiable()) return;
  const double threshold = 1000 * *here.parameter("threshold").value - 300;
  RC_ASSERT(std::abs(threshold - *there.parameter("threshold").value) < 0.1);
}

// Answers of a few people to levels that are one-sided, around 0, or close together: collinear,
// separated and flat likelihoods among them. @param each is called with the answers
template <typename Each>
void for_some_people(int n, std::string_view stream, const Each& each) {
  const std::vector<std::vector<double>> sets{
      {10, 20, 40, 80}, {-40, -20, 0, 20, 40}, {-80, -10, 5, 70, 150}, {20, 25, 30}};
  RandomStream random(1, stream);
  const auto one_of = [&](std::initializer_list<double> all) {
    return all
        .begin()[static_cast<std::size_t>(random.uniform() * static_cast<double>(all.size()))];
  };
  for (int i = 0; i < n; ++i) {
    const IndecisionParameters person{one_of({0.01, 0.03, 0.06}), one_of({0, 0.2, 0.5, 1, 2}),
                                      one_of({0, 0.2, 1, -0.5}), one_of({0, 0, 0.02, 0.1})};
    const int n_per_level = static_cast<int>(one_of({3, 4, 5, 10, 20}));
    each(choices_of(person, sets[static_cast<std::size_t>(i) % sets.size()], n_per_level, random));
  }
}

double low_end(const FittedParameter& parameter) {
  return parameter.low.value_or(-std::numeric_limits<double>::infinity());
}
double high_end(const FittedParameter& parameter) {
  return parameter.high.value_or(std::numeric_limits<double>::infinity());
}

// @return how much narrower, relative to the interval or to the value, whichever is more
double narrower_by(const FittedParameter& free, const FittedParameter& fixed) {
  const double width = high_end(fixed) - low_end(fixed);
  const double scale =
      std::max(std::isfinite(width) ? width : 0, std::abs(fixed.value.value_or(1)));
  const double low = low_end(free) > low_end(fixed) ? low_end(free) - low_end(fixed) : 0;
  const double high = high_end(free) < high_end(fixed) ? high_end(fixed) - high_end(free) : 0;
  return std::max(low, high) / scale;
}

// Where the likeliest lapse rate is the fixed one, other likely lapse rates can only make the other
// parameters less certain.
TEST(IndecisionFit, AFreeLapseNeverMakesNarrower) {
  int n_compared = 0;
  for_some_people(150, "free lapse", [&](const AnswersByLevel& answers) {
    const Fit fixed = fit_indecision(answers, {{}, 0, 0}),
              free = fit_indecision(answers, {{}, 0, {}});
    if (free.parameter("lapse").value > 1e-9) return;
    ++n_compared;
    for (const char* name : {"sensitivity", "indecision", "bias"})
      EXPECT_LT(narrower_by(free.parameter(name), fixed.parameter(name)), 1e-3)
          << name << " of " << testing::PrintToString(answers);
  });
  EXPECT_GT(n_compared, 60);
}

TEST(PsychometricFit, AFreeLapseNeverMakesNarrower) {
  const std::vector<double> mostly_above{5, 17, 29, 41, 53, 65, 77, 89};
  RandomStream random(1, "free lapse");
  int n_compared = 0;
  for (int i = 0; i < 60; ++i) {
    const AnswersByLevel answers = answers_of({{}, {22, 4, 0.5, 0}}, mostly_above, 40, random);
    const Fit fixed = fit_psychometric(answers, {{}, 0.5, 0});
    const Fit free = fit_psychometric(answers, {{}, 0.5, {}});
    if (!fixed.identifiable() || !free.identifiable() || free.parameter("lapse").value > 1e-9)
      continue;
    ++n_compared;
    for (const char* name : {"threshold", "slope"})
      EXPECT_LT(narrower_by(free.parameter(name), fixed.parameter(name)), 1e-3)
          << name << " of " << testing::PrintToString(answers);
  }
  EXPECT_GT(n_compared, 12);
}

void expect_same(const std::optional<double>& there, const std::optional<double>& here,
                 double within) {
  ASSERT_EQ(there.has_value(), here.has_value());
  if (here) {
    EXPECT_NEAR(*there, *here, within);
  }
}

// Absolute masses instead of differences change only the bias, which is that at level 0.
TEST(IndecisionFit, TheOriginOfTheLevelsOnlyMattersToTheBias) {
  for_some_people(100, "origin", [&](const AnswersByLevel& answers) {
    const Fit here = fit_indecision(answers, {{}, 0, 0});
    for (const double off : {1e3, 1e5}) {
      AnswersByLevel moved;
      for (const auto& [level, n] : answers) moved[level + off] = n;
      const Fit there = fit_indecision(moved, {{}, 0, 0});
      SCOPED_TRACE(testing::PrintToString(moved));
      for (const char* name : {"sensitivity", "indecision"}) {
        const FittedParameter &a = here.parameter(name), &b = there.parameter(name);
        const double width = std::min(high_end(a) - low_end(a), 1 + std::abs(a.value.value_or(0)));
        expect_same(b.value, a.value, 1e-4 * width);
        expect_same(b.se, a.se, 1e-4 * width);
        expect_same(b.low, a.low, 1e-4 * width);
        expect_same(b.high, a.high, 1e-4 * width);
      }
      // With an origin far from all levels, the bias varies with the sensitivity, with opposite
      // sign.
      const FittedParameter &bias = there.parameter("bias"), &s = here.parameter("sensitivity");
      if (off < 1e5 || !bias.value || !s.value || !bias.low || !bias.high || !s.low || !s.high)
        continue;
      EXPECT_NEAR(-*bias.high / off, *s.low, 0.02 * (*s.high - *s.low));
      EXPECT_NEAR(-*bias.low / off, *s.high, 0.02 * (*s.high - *s.low));
    }
  });
}

// A free lapse rate causes several local maxima, and with separated answers the estimate is far
// out: the interval's end must not depend on where the search starts.
TEST(IndecisionFit, WithAFreeLapseTheOriginDoesNotMoveTheEnds) {
  RandomStream random(1, "origin, free lapse");
  for (int i = 0; i < 60; ++i) {
    std::vector<double> levels;
    for (int k = 0; k < 9; ++k) levels.push_back(std::round(800 * random.uniform() - 400));
    const IndecisionParameters person{i % 2 == 0 ? 0.005 : 0.03, 0.3 + 0.4 * (i % 5), 0.3, 0.1};
    const AnswersByLevel answers = choices_of(person, levels, 2 + i % 4, random);
    AnswersByLevel moved;
    for (const auto& [level, n] : answers) moved[level + 1000] = n;
    const Fit here = fit_indecision(answers, {{}, 0, {}}),
              there = fit_indecision(moved, {{}, 0, {}});
    SCOPED_TRACE(testing::PrintToString(answers));
    EXPECT_NEAR(*there.log_likelihood, *here.log_likelihood, 1e-5);
    const FittedParameter &a = here.parameter("sensitivity"), &b = there.parameter("sensitivity");
    expect_same(b.low, a.low, 1e-3 * (1e-3 + std::abs(a.low.value_or(0))));
    expect_same(b.high, a.high, 1e-3 * (1e-3 + std::abs(a.high.value_or(0))));
  }
}

// The answers are separated, so that the maximum is at infinity; the last digits decide where a
// search ends, and a distant origin changes these.
TEST(IndecisionFit, TheLastDigitsOfTheLevelsDoNotMoveTheEnds) {
  const AnswersByLevel answers{{-394, {1, 1, 0}}, {-254, {2, 0, 0}}, {-249, {2, 0, 0}},
                               {-205, {1, 1, 0}}, {-102, {1, 0, 1}}, {-98, {0, 2, 0}},
                               {54, {0, 2, 0}},   {104, {0, 1, 1}},  {363, {0, 0, 2}}};
  AnswersByLevel moved;
  for (const auto& [level, n] : answers) moved[level + 1000] = n;
  const Fit here = fit_indecision(answers, {{}, 0, {}}), there = fit_indecision(moved, {{}, 0, {}});
  EXPECT_NEAR(*there.log_likelihood, *here.log_likelihood, 1e-9);
  for (const char* name : {"sensitivity", "indecision", "lapse"})
    expect_same(there.parameter(name).low, here.parameter(name).low, 1e-9);
}

// Whatever the answers are: the figures are finite, in order, and there or not as `why` says.
// R's ordinal::clm has the same standard error, and none that means anything for the two
// thresholds: there are no answers near one of them.
TEST(IndecisionFit, WhatIsLeftOpenTakesNoStandardErrorFromTheSensitivity) {
  const Fit fit = fit_indecision(
      {{-222, {29, 0, 0}}, {-137.2, {46, 1, 0}}, {-69.6, {15, 26, 0}}, {284.4, {0, 0, 33}}}, {});
  EXPECT_NEAR(fit.parameter("sensitivity").se.value(), 0.0067812, 0.00002);
  EXPECT_TRUE(fit.parameter("threshold_75_g").se);
  for (const char* open : {"indecision", "bias"}) {  // as likely all around
    EXPECT_EQ(fit.parameter(open).value, std::nullopt) << open;
    EXPECT_FALSE(fit.parameter(open).se) << open;
    EXPECT_TRUE(fit.parameter(open).low) << open;
  }
}

RC_GTEST_PROP(Fit, OfAnyAnswersIsConsistent, ()) {
  AnswersByLevel answers;
  const int n_levels = *rc::gen::inRange(1, 7);
  for (int i = 0; i < n_levels; ++i)
    for (double& n : answers[*rc::gen::inRange(-5, 20)]) n = *rc::gen::inRange(0, 12);
  const bool indecision = *rc::gen::arbitrary<bool>();
  FitOptions options{{*rc::gen::element(PsychometricShape::cumulative_normal,
                                        PsychometricShape::gumbel, PsychometricShape::logistic),
                      LevelScale::linear},
                     *rc::gen::element<std::optional<double>>(0, 0.5, std::nullopt),
                     *rc::gen::element<std::optional<double>>(0, 0.02, std::nullopt)};
  if (!indecision)
    for (auto& [level, n] : answers) n[2] = 0;
  const Fit fit =
      indecision ? fit_indecision(answers, options) : fit_psychometric(answers, options);
  const FittedParameter& threshold = fit.parameter(indecision ? "threshold_75_g" : "threshold");
  RC_ASSERT(fit.identifiable() == threshold.value.has_value());
  RC_ASSERT(fit.log_likelihood.value_or(0) <= 0);
  for (const FittedParameter& parameter : fit.parameters) {
    if (!parameter.value) continue;
    RC_ASSERT(std::isfinite(*parameter.value));
    RC_ASSERT(!parameter.se || (std::isfinite(*parameter.se) && *parameter.se > 0));
    if (parameter.low) RC_ASSERT(*parameter.low <= *parameter.value + 1e-9);
    if (parameter.high) RC_ASSERT(*parameter.high >= *parameter.value - 1e-9);
  }
}

// The shares of "different" that the model gives: whatever the criterion, one sensitivity.
TEST(SameDifferentFit, FindsTheSensitivityOfAnyCriterion) {
  for (const double indecision : {0.3, 1.5, 2.5}) {
    AnswersByLevel answers;
    for (const double level_g : {0.0, 50.0, 100.0, -200.0, 300.0}) {
      const IndecisionShares shares = indecision_shares({0.01, indecision, 0, 0}, level_g);
      const double different = 0.01 + 0.98 * (1 - shares.none);
      answers[level_g] = {1000 * (1 - different), 1000 * different, 0};
    }
    const Fit fit = fit_same_different(answers, 0.02);
    ASSERT_TRUE(fit.identifiable()) << fit.why;
    EXPECT_NEAR(*fit.parameter("sensitivity").value, 0.01, 1e-6) << indecision;
    EXPECT_NEAR(*fit.parameter("indecision").value, indecision, 1e-4);
    EXPECT_NEAR(*fit.parameter("threshold_75_g").value, 67.45, 0.01);
  }
}

TEST(SameDifferentFit, HasNoThresholdWithoutInformation) {
  const auto why = [](const AnswersByLevel& answers) {
    return fit_same_different(answers, 0.02).why;
  };
  EXPECT_FALSE(why({}).empty());
  EXPECT_FALSE(why({{100, {10, 20, 0}}}).empty()) << "one level";
  EXPECT_FALSE(why({{0, {40, 0, 0}}, {100, {40, 0, 0}}}).empty()) << "always same";
  EXPECT_FALSE(why({{0, {0, 40, 0}}, {100, {0, 40, 0}}}).empty()) << "always different";
  EXPECT_FALSE(why({{0, {40, 0, 0}}, {100, {0, 40, 0}}}).empty()) << "complete separation";
  EXPECT_FALSE(why({{0, {10, 30, 0}}, {100, {20, 20, 0}}, {200, {30, 10, 0}}}).empty())
      << "larger differences were answered by same";
}

// At most 5 % of coins seem to have a threshold.
TEST(SameDifferentFit, OfCoinsIsNotIdentifiable) {
  RandomStream random(3, "coins");
  int n_identifiable = 0;
  constexpr int n = 200;
  for (int i = 0; i < n; ++i) {
    AnswersByLevel answers;
    for (const double level_g : {0.0, 60.0, 120.0, 180.0})
      for (int trial = 0; trial < 15; ++trial) answers[level_g][random.coin(0.5) ? 1 : 0] += 1;
    n_identifiable += fit_same_different(answers, 0.02).identifiable();
  }
  EXPECT_LE(n_identifiable, n / 20);
}

}  // namespace
}  // namespace heft
