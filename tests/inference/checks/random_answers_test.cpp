// Random answers against the answers of people with a threshold, in up-down staircases.
#include <gtest/gtest.h>

#include <functional>

#include "inference/MaximumLikelihood.h"
#include "inference/checks/RandomAnswers.h"
#include "psychophysics/ProcedureKinds.h"

namespace heft {
namespace {

std::shared_ptr<const Procedure> up_down() {
  UpDownConfig config;
  config.start = 400;
  config.steps = {120, 60, 30};
  config.floor = 10;
  config.stop_reversals = 8;
  config.stop_trials = 30;
  return std::make_shared<const Procedure>("heavy", config);
}

using ShareOfYes = std::function<double(double level_g)>;

AnsweredLevels person(const ShareOfYes& share, RandomStream& stream) {
  AnsweredLevels person{{}, {{up_down()}}};
  Procedure procedure = *person.staircases.front().before;
  while (!procedure.finished()) {
    const double level_g = procedure.next_level(stream);
    const bool yes = stream.coin(share(level_g));
    person.answers[level_g][yes ? 1 : 0] += 1;
    procedure.respond({yes, {}}, level_g);
  }
  return person;
}

// How many of 100 studies have p < .05.
int n_below_5_percent(const ShareOfYes& share, int n_people) {
  int n = 0;
  for (int study = 0; study < 100; ++study) {
    RandomStream stream(1, "study " + std::to_string(study));
    std::vector<AnsweredLevels> people;
    for (int i = 0; i < n_people; ++i) people.push_back(person(share, stream));
    n += p_of_random_answers(people) < 0.05 ? 1 : 0;
  }
  return n;
}

TEST(RandomAnswers, PassInFivePercentOfStudies) {
  for (const double rate : {0.3, 0.5})
    for (const int n_people : {1, 8})
      EXPECT_LE(n_below_5_percent([&](double) { return rate; }, n_people), 10)
          << rate << ", " << n_people << " people";  // 5 % and two SDs
}

TEST(RandomAnswers, PassTheChiSquareTestInMostStaircases) {
  RandomStream stream(1, "coins");
  int n = 0;
  for (int i = 0; i < 200; ++i)
    n += gain_of_levels(person([](double) { return 0.5; }, stream).answers) > 2 * interval_drop;
  EXPECT_GT(n, 100) << "otherwise the simulated distribution is not needed";
}

TEST(RandomAnswers, OfPeopleWithAThresholdDoNot) {
  const ShareOfYes steep = [](double g) { return 0.01 + 0.98 * normal_cdf((g - 110) / 20); };
  const ShareOfYes flat = [](double g) { return 0.01 + 0.98 * normal_cdf((g - 110) / 60); };
  EXPECT_EQ(n_below_5_percent(steep, 8), 100);
  EXPECT_GE(n_below_5_percent(flat, 8), 95);
  EXPECT_GE(n_below_5_percent(steep, 1), 50) << "a single staircase is short";
}

TEST(RandomAnswers, GainIsTheLikelihoodRatioOfALogisticFunction) {
  EXPECT_NEAR(gain_of_levels({{0, {8, 2}}, {1, {2, 8}}}), 2 * 3.854895, 1e-4);
  EXPECT_NEAR(gain_of_levels({{0, {10, 0}}, {1, {0, 10}}}), 40 * std::log(2.), 1e-2) << "a step";
  EXPECT_EQ(gain_of_levels({{0, {2, 8}}, {1, {8, 2}}}), 0) << "falling";
  EXPECT_EQ(gain_of_levels({{0, {0, 8}}, {1, {0, 2}}}), 0) << "all are the same";
}

TEST(RandomAnswers, ToFixedLevelsAreOfTheSameNumber) {
  const AnsweredLevels clear{{{-50, {9, 1}}, {50, {1, 9}}}}, unclear{{{-50, {5, 5}}, {50, {5, 5}}}};
  EXPECT_LT(p_of_random_answers(std::vector{clear}), 0.05);
  EXPECT_GT(p_of_random_answers(std::vector{unclear}), 0.5);
}

}  // namespace
}  // namespace heft
