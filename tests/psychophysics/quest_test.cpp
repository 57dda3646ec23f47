// QUEST as a value: numbers that stay finite, replays, bounds, and estimates only where there is
// something to estimate. tests/cli/procedure/bayesian_test.py compares it with its authors'
// formulas.
#include "psychophysics/Quest.h"

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numeric>

#include "psychophysics/BayesianKinds.h"
#include "psychophysics/Procedure.h"

namespace heft {
namespace {

using testing::HasSubstr;

QuestConfig quest_in_decades(int trials) {
  QuestConfig config;
  config.guess = -1;
  config.guess_sd = 2;
  config.stop_trials = trials;
  return config;
}

Response seen(const QuestConfig& config, double threshold, double level, RandomStream& stream) {
  // p(threshold) = 0.82 with beta 3.5, delta 0.01 and gamma 0.5 is 0.0041 decades off the
  // Weibull's.
  const double p =
      config.delta * config.gamma +
      (1 - config.delta) *
          (1 - (1 - config.gamma) * std::exp(-std::pow(10, 3.5 * (level - threshold))));
  return {stream.coin(p)};
}

RC_GTEST_PROP(QuestProperty, StaysAProbabilityForThousandsOfTrials, ()) {
  QuestConfig config = quest_in_decades(10'000);
  config.placement =
      *rc::gen::element(QuestPlacement::quantile, QuestPlacement::mean, QuestPlacement::mode);
  config.gamma = *rc::gen::inRange(0, 60) / 100.0;
  config.delta = *rc::gen::inRange(0, 20) / 100.0;
  config.p_threshold = config.gamma + 0.6 * (1 - config.gamma) * (1 - config.delta);
  Quest quest(config), again = quest;
  RandomStream stream(*rc::gen::arbitrary<std::uint64_t>(), "answers");
  const double p = *rc::gen::element(0.0, 0.5, 0.9, 1.0);
  for (int trial = 0; trial < 3000; ++trial) {
    const double level = quest.next_level(stream);
    RC_ASSERT(level >= -3.5 - 1e-9);
    RC_ASSERT(level <= 1.5 + 1e-9);
    const double shown = stream.coin(0.05) ? 1e300 * (stream.uniform() - 0.5) : level;
    const Response response{stream.coin(p)};
    quest.respond(response, shown);
    again.respond(response, shown);
    RC_ASSERT(again.next_level(stream) == quest.next_level(stream));
  }
  const auto& weights = quest.threshold().weights;
  RC_ASSERT(std::abs(std::accumulate(weights.begin(), weights.end(), 0.0) - 1) < 1e-9);
  RC_ASSERT(std::isfinite(quest.posterior()[0].sd));
}

TEST(Quest, EstimatesAThresholdAndStopsByItsPrecision) {
  QuestConfig config = quest_in_decades(200);
  config.stop_ci_width = 0.3;
  double squares = 0;
  for (std::uint64_t i = 0; i < 100; ++i) {
    RandomStream draw(i, "person");
    const double threshold = -2 + 2 * draw.uniform();
    const Procedure quest("s", config);
    const Estimate estimate = test::estimate_of(quest, i, [&](double level, auto& stream) {
      return seen(config, threshold, level, stream);
    });
    ASSERT_TRUE(estimate.value);
    EXPECT_LE(*estimate.high - *estimate.low, 0.3);
    EXPECT_LT(estimate.n_trials, 200);
    squares += std::pow(*estimate.value - threshold, 2);
  }
  EXPECT_LT(std::sqrt(squares / 100), 0.1);
}

TEST(Quest, ConstantAnswersAndCoinsHaveNoEstimate) {
  const Procedure quest("s", quest_in_decades(60));
  int n_estimates = 0;
  for (std::uint64_t i = 0; i < 100; ++i)
    n_estimates += test::estimate_of(
                       quest, i,
                       [](double, auto& stream) {
                         return Response{stream.coin(0.5)};
                       }).value
                       ? 1
                       : 0;
  EXPECT_LE(n_estimates, 5);
  EXPECT_FALSE(test::estimate_of(quest, 1, [](double, auto&) { return Response{true}; }).value);
  EXPECT_FALSE(test::estimate_of(quest, 1, [](double, auto&) { return Response{false}; }).value);
}

TEST(Quest, StaysWithinFloorAndCeilingAndBeginsAtTheStart) {
  QuestConfig config = quest_in_decades(50);
  config.start = -1.25;
  config.floor = -1.5;
  config.ceiling = -0.5;
  Quest quest(config);
  const RandomStream stream(1, "s");
  EXPECT_EQ(quest.next_level(stream), -1.25);
  quest.respond({true}, -1.25);
  for (int i = 0; i < 20; ++i) quest.respond({true}, quest.next_level(stream));
  EXPECT_EQ(quest.next_level(stream), -1.5);
}

TEST(QuestConfig, NamesItsMistakes) {
  QuestConfig config = quest_in_decades(50);
  EXPECT_TRUE(config.check().empty());
  config.p_threshold = 0.45;  // below gamma
  EXPECT_THAT(config.check().at(0).text(), HasSubstr("p_threshold is 0.45"));
  config = quest_in_decades(50);
  config.range = 1e6;
  EXPECT_THAT(config.check().at(0).text(), HasSubstr("2 to 20000 grains"));
  config = quest_in_decades(50);
  EXPECT_THAT(config.check_beside(200).at(0).text(), HasSubstr("lacks \"floor\""));
  config.floor = 0;
  EXPECT_TRUE(config.check_beside(200).empty());
}

}  // namespace
}  // namespace heft
