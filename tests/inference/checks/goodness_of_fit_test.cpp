// Goodness of fit: deviances and p values as in R, how often right and wrong curves are rejected,
// and what cannot be judged.
#include <gmock/gmock.h>

#include <cmath>
#include <iostream>

#include "base/Random.h"
#include "inference/Coverage.h"
#include "inference/checks/GoodnessOfFit.h"

namespace heft {
namespace {

using testing::HasSubstr;

GoodnessOfFit checked(const AnswersByLevel& answers, const FitOptions& options = {}) {
  return check_psychometric(answers, options, fit_psychometric(answers, options));
}

// R: deviance(glm(cbind(y, n - y) ~ x, binomial(probit))), and its distribution in 20 000 simulated
// and refitted data sets.
TEST(GoodnessOfFit, OfANormalCurveIsThatOfGlm) {
  const GoodnessOfFit found = checked({{-160, {38, 2, 0}},
                                       {-80, {33, 7, 0}},
                                       {-40, {27, 13, 0}},
                                       {40, {11, 29, 0}},
                                       {80, {7, 33, 0}},
                                       {160, {1, 39, 0}}});
  EXPECT_NEAR(*found.deviance, 0.51952466780, 1e-6);
  EXPECT_EQ(found.degrees_of_freedom, 4);
  EXPECT_NEAR(*found.p, 0.978, 0.015);
  EXPECT_TRUE(found.fits());
}

// R: the same with binomial(logit) and 4000 data sets.
TEST(GoodnessOfFit, OfALogisticCurveIsThatOfGlm) {
  const GoodnessOfFit found = checked({{1, {40, 0, 0}},
                                       {2, {38, 2, 0}},
                                       {3, {32, 8, 0}},
                                       {4, {20, 20, 0}},
                                       {5, {9, 31, 0}},
                                       {6, {7, 33, 0}},
                                       {7, {8, 32, 0}}},
                                      {.function = {PsychometricShape::logistic}});
  EXPECT_NEAR(*found.deviance, 15.0156447315, 1e-6);
  EXPECT_EQ(found.degrees_of_freedom, 5);
  EXPECT_NEAR(*found.p, 0.013, 0.012);
  EXPECT_FALSE(found.fits());
}

// R: optim() of the three-way likelihood, and 1500 data sets.
TEST(GoodnessOfFit, OfThreeAnswersCountsTwoSharesAtEachLevel) {
  const AnswersByLevel answers{
      {-100, {26, 3, 1}}, {-50, {17, 9, 4}}, {0, {6, 18, 6}}, {50, {3, 10, 17}}, {100, {1, 4, 25}}};
  const GoodnessOfFit found = check_indecision(answers, {}, fit_indecision(answers, {}));
  EXPECT_NEAR(*found.deviance, 5.347624035, 1e-5);
  EXPECT_EQ(found.degrees_of_freedom, 7);
  EXPECT_NEAR(*found.p, 0.661, 0.06);
}

// SciPy: minimize() of the likelihood with 2 % lapses, 4000 data sets and 2000.
TEST(GoodnessOfFit, OfSameAndDifferentIsThatOfTheDifferencingModel) {
  const GoodnessOfFit right = check_same_different({{0, {30, 10, 0}},
                                                    {60, {24, 16, 0}},
                                                    {120, {14, 26, 0}},
                                                    {180, {5, 35, 0}},
                                                    {240, {1, 39, 0}}});
  EXPECT_NEAR(*right.deviance, 0.151615037, 1e-6);
  EXPECT_EQ(right.degrees_of_freedom, 3);
  EXPECT_NEAR(*right.p, 0.9875, 0.011);
  const GoodnessOfFit wrong = check_same_different({{0, {36, 4, 0}},
                                                    {-60, {10, 10, 0}},
                                                    {60, {14, 6, 0}},
                                                    {120, {12, 28, 0}},
                                                    {180, {10, 30, 0}},
                                                    {240, {9, 31, 0}}});
  EXPECT_NEAR(*wrong.deviance, 15.6417017, 1e-6) << "differences of either sign are one level";
  EXPECT_EQ(wrong.degrees_of_freedom, 3);
  EXPECT_NEAR(*wrong.p, 0.003, 0.005);
  EXPECT_FALSE(wrong.fits());
}

AnswersByLevel answers_of(int n_per_level, double lapse, std::uint64_t seed) {
  RandomStream stream(seed, "observer");
  AnswersByLevel answers;
  for (const double level : {-240.0, -160.0, -80.0, 0.0, 80.0, 160.0, 240.0})
    for (int i = 0; i < n_per_level; ++i) {
      const double p = probability(
          {}, {.threshold = 10, .slope = 90, .guess = lapse / 2, .lapse = lapse / 2}, level);
      answers[level][stream.coin(p) ? 1 : 0] += 1;
    }
  return answers;
}

TEST(CoverageOf, RejectedCurves) {
  const int studies = n_studies(30);
  const FitOptions usual{.guess = 0.01, .lapse = 0.01};
  for (const auto& [name, n_per_level, lapse, options, fewest, most] :
       {std::tuple{"right curve, 20 trials at a level", 20, 0.02, usual, 0.0, 0.05},
        {"right curve, 100 trials at a level", 100, 0.02, usual, 0.0, 0.05},
        {"right curve with free rates", 40, 0.1, FitOptions{.guess = {}, .lapse = {}}, 0.0, 0.05},
        {"lapses of .2 hidden, 300 trials at a level", 300, 0.2, usual, 0.8, 1.0}}) {
    int n_rejected = 0, n_judged = 0;
    for (int i = 0; i < studies; ++i) {
      const GoodnessOfFit found =
          checked(answers_of(n_per_level, lapse, static_cast<std::uint64_t>(i + 1)), options);
      n_judged += found.p ? 1 : 0;
      n_rejected += found.fits() ? 0 : 1;
    }
    std::cout << name << ": " << 100.0 * n_rejected / n_judged << " % rejected\n";
    ASSERT_GT(n_judged, 0.9 * studies) << name;
    const double chance = 3 * std::sqrt(0.05 * 0.95 / n_judged);
    EXPECT_GE(n_rejected, (fewest - chance) * n_judged) << name;
    EXPECT_LE(n_rejected, (most + chance) * n_judged) << name;
  }
}

TEST(CoverageOf, RejectedSameDifferentCurves) {
  const int studies = n_studies(30);
  int n_rejected = 0, n_judged = 0;
  for (int i = 0; i < studies; ++i) {
    RandomStream stream(static_cast<std::uint64_t>(i + 1), "same-different observer");
    AnswersByLevel answers;
    for (const double level : {0.0, 50.0, 100.0, 150.0, 200.0, 250.0})
      for (int trial = 0; trial < 40; ++trial) {
        const double same = 0.01 + 0.98 * indecision_shares({0.011, 1, 0, 0}, level).none;
        answers[level][stream.coin(same) ? 0 : 1] += 1;
      }
    const GoodnessOfFit found = check_same_different(answers);
    n_judged += found.p ? 1 : 0;
    n_rejected += found.fits() ? 0 : 1;
  }
  std::cout << "right same-different curve: " << 100.0 * n_rejected / n_judged << " % rejected\n";
  ASSERT_GT(n_judged, 0.9 * studies);
  EXPECT_LE(n_rejected, (0.05 + 3 * std::sqrt(0.05 * 0.95 / n_judged)) * n_judged);
}

std::string why(const AnswersByLevel& answers) {
  const GoodnessOfFit found = checked(answers);
  EXPECT_FALSE(found.p || found.deviance);
  EXPECT_TRUE(found.fits());
  return found.why;
}

TEST(GoodnessOfFit, OfAnAdaptiveProcedureIsNotJudged) {
  EXPECT_THAT(why({{1, {5, 0, 0}}, {2, {18, 4, 0}}, {3, {9, 20, 0}}, {4, {2, 12, 0}}}),
              HasSubstr("levels have 5 to 29 trials, as where an adaptive procedure chose them"));
}

TEST(GoodnessOfFit, OfTooFewTrialsIsNotJudged) {
  EXPECT_THAT(why({{1, {4, 0, 0}}, {2, {3, 1, 0}}, {3, {1, 3, 0}}, {4, {0, 4, 0}}, {5, {0, 4, 0}}}),
              HasSubstr("4 trials at a level are too few, expected 5 or more"));
}

TEST(GoodnessOfFit, NeedsMoreLevelsThanParameters) {
  EXPECT_THAT(why({{1, {30, 10, 0}}, {2, {10, 30, 0}}}), HasSubstr("it has as many parameters"));
}

TEST(GoodnessOfFit, NeedsAThreshold) {
  EXPECT_EQ(why({{1, {10, 10, 0}}, {2, {10, 10, 0}}, {3, {10, 10, 0}}}), "there is no threshold");
}

}  // namespace
}  // namespace heft
