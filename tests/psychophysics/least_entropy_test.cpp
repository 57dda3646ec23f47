// QUEST+ and Psi: values that are copied and replayed, numbers that stay finite, and estimates only
// where the responses identify them. Levels and posteriors are compared with other implementations
// in tests/cli/procedure/bayesian_test.py.
#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <map>
#include <numeric>

#include "psychophysics/BayesianKinds.h"
#include "psychophysics/LeastEntropy.h"
#include "psychophysics/ProcedureKinds.h"

namespace heft {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::string> mistakes_of(const auto& config) {
  std::vector<std::string> texts;
  for (const ConfigMistake& mistake : config.check()) texts.push_back(mistake.text());
  return texts;
}

double total(const Marginal& marginal) {
  return std::accumulate(marginal.weights.begin(), marginal.weights.end(), 0.0);
}

RC_GTEST_PROP(LeastEntropyProperty, StaysAProbabilityForThousandsOfTrials, ()) {
  Psi psi(test::any_psi(10'000));
  const std::vector<double>& levels = psi.grid().table().space().levels;
  RandomStream stream(*rc::gen::arbitrary<std::uint64_t>(), "answers");
  for (int trial = 0; trial < 2000; ++trial) {
    const double level = psi.next_level(stream);
    RC_ASSERT(std::ranges::count(levels, level) == 1);
    const bool off_plan = stream.coin(0.05);
    Response response = response_of(static_cast<Choice>(stream.below(3)));
    psi.respond(response, off_plan ? 1e300 * (stream.uniform() - 0.5) : level);
  }
  for (std::size_t i = 0; i < 4; ++i) RC_ASSERT(std::abs(total(psi.grid().marginal(i)) - 1) < 1e-9);
  for (const double entropy : psi.grid().expected_entropies()) RC_ASSERT(std::isfinite(entropy));
  for (const ParameterPosterior& one : psi.posterior())
    for (const double value : {one.mean, one.sd, one.mode, one.low, one.high})
      RC_ASSERT(std::isfinite(value));
  RC_ASSERT(std::isfinite(psi.grid().log_evidence()));
}

RC_GTEST_PROP(LeastEntropyProperty, ReplaysToTheSameTraceAndCopiesAreApart, ()) {
  const PsiConfig config = test::any_psi(30);
  Procedure first("s", config), other = first;
  const RandomStream stream = level_stream(1, "s");
  std::vector<std::pair<Response, double>> answers;
  std::vector<double> levels;
  while (!first.finished()) {
    levels.push_back(first.next_level(stream));
    answers.emplace_back(test::any_response(), levels.back());
    first.respond(answers.back().first, levels.back());
  }
  RC_ASSERT(other.n_trials() == 0);
  for (std::size_t i = 0; i < answers.size(); ++i) {
    RC_ASSERT(other.next_level(stream) == levels[i]);
    other.respond(answers[i].first, answers[i].second);
  }
  RC_ASSERT(other.finish() == StopReason::trials);
  RC_ASSERT(other.estimates()[0].value == first.estimates()[0].value);
  for (std::size_t i = 0; i < first.posterior().size(); ++i)
    RC_ASSERT(first.posterior()[i].mean == other.posterior()[i].mean);
}

// The definition, point by point: every outcome's posterior, its sums over the nuisance parameters,
// and their entropy times the outcome's probability.
double expected_entropy(const LikelihoodTable& table, const std::vector<double>& weights,
                        double level) {
  const ResponseModel& model = table.space().model;
  double expected = 0;
  for (std::size_t outcome = 0; outcome < model.n_outcomes(); ++outcome) {
    std::map<std::size_t, double> joint;
    double probability = 0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
      const OutcomeShares fixed = model.inattentive(table.point(i));
      const double p = fixed[outcome] + (1 - fixed[0] - fixed[1] - fixed[2]) *
                                            model.attentive(table.point(i), level)[outcome];
      joint[i / table.n_nuisance()] += weights[i] * p;
      probability += weights[i] * p;
    }
    for (const auto& [group, p] : joint)
      if (p > 0) expected -= p * std::log(p / probability);
  }
  return expected;
}

RC_GTEST_PROP(LeastEntropyProperty, ExpectsTheEntropyOfTheDefinition, ()) {
  GridSpace space{.model = {}, .parameters = {}, .levels = {-60, -5, 0, 20, 80}};
  space.model.function = static_cast<ResponseFunction>(*rc::gen::element(0, 1, 4));
  space.parameters = space.model.is_indecision()
                         ? decltype(space.parameters){{{0.01, 0.02}, {0, 0.5, 1}, {0, 0.2}, {}}}
                         : decltype(space.parameters){{{10, 30}, {5, 10, 20}, {0, 0.1}, {}}};
  const std::vector<double> lapses[] = {{0.02}, {0, 0.05, 0.1}, test::spaced(0, 0.2, 40).values};
  space.parameters[3] = *rc::gen::elementOf(std::vector(std::begin(lapses), std::end(lapses)));
  for (std::size_t i = 1; i < 4; ++i) space.is_nuisance[i] = *rc::gen::arbitrary<bool>();
  const auto table = std::make_shared<const LikelihoodTable>(space);
  PosteriorGrid grid(table);
  std::vector<double> weights(table->n_points(), 1.0 / static_cast<double>(table->n_points()));
  for (int trial = 0; trial < 3; ++trial) {
    const auto entropies = grid.expected_entropies();
    for (std::size_t x = 0; x < space.levels.size(); ++x)
      RC_ASSERT(std::abs(entropies[static_cast<Eigen::Index>(x)] -
                         expected_entropy(*table, weights, space.levels[x])) < 1e-6);
    const Response response = test::any_response();
    const double level = *rc::gen::elementOf(space.levels);
    const auto outcomes = space.model.outcomes_of(response);
    double sum = 0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
      const OutcomeShares fixed = space.model.inattentive(table->point(i));
      const OutcomeShares attentive = space.model.attentive(table->point(i), level);
      double p = 0;
      for (std::size_t k = 0; k < 3; ++k)
        if (outcomes[k]) p += fixed[k] + (1 - fixed[0] - fixed[1] - fixed[2]) * attentive[k];
      sum += weights[i] *= p;
    }
    for (double& weight : weights) weight /= sum;
    grid.update(level, response);
  }
}

// The entropies of 21 x 50 mixes of guesses and lapses come from those of a few.
TEST(LeastEntropy, AFewMixesOfGuessesAndLapsesGiveTheEntropiesOfAll) {
  GridSpace space{.model = {}, .parameters = {}, .levels = {-8, -1, 0, 0.5, 2, 40}};
  space.parameters = {{{0}, {1}, test::spaced(0, 0.5, 21).values, test::spaced(0, 0.2, 50).values}};
  const LikelihoodTable table(space);
  EXPECT_LT(table.combinations().rows(), 40);
  const Eigen::MatrixXd all = table.entropies().cast<double>() * table.combinations();
  for (std::size_t i = 0; i < table.n_points(); ++i)
    for (std::size_t x = 0; x < space.levels.size(); ++x) {
      const double lapse = table.point(i)[3], guess = table.point(i)[2];
      const double p = guess + (1 - guess - lapse) * normal_cdf(space.levels[x]);
      const double entropy = p > 0 && p < 1 ? -p * std::log(p) - (1 - p) * std::log1p(-p) : 0;
      ASSERT_NEAR(all(static_cast<Eigen::Index>(x), static_cast<Eigen::Index>(i)), entropy, 1e-7)
          << "guess " << guess << ", lapse " << lapse << ", level " << space.levels[x];
    }
}

TEST(LeastEntropy, AnImpossibleResponseLeavesTheOthersInOrder) {
  QuestPlusConfig config = test::detection_of_grams<QuestPlusConfig>(5000);
  config.guess = config.lapse = {{0}};
  QuestPlus procedure(config);
  for (int i = 0; i < 2000; ++i) procedure.respond({true}, 400);
  for (int i = 0; i < 2000; ++i) procedure.respond({false}, -1e6);
  for (int i = 0; i < 500; ++i) procedure.respond({false}, 1e6);  // each has probability 0
  for (int i = 0; i < 300; ++i) procedure.respond({i % 2 == 0}, 200);
  const ParameterPosterior threshold = procedure.posterior()[0];
  EXPECT_NEAR(threshold.mean, 200, 10);
}

TEST(LeastEntropy, EqualGridsShareOneTable) {
  const PsiConfig config = test::heavier_at_200g(40);
  const Psi one(config);
  Psi other(config);
  other.respond(response_of(Choice::none), 100);
  EXPECT_EQ(&one.grid().table(), &other.grid().table());
  PsiConfig different = config;
  different.lapse = {{0.03}};
  EXPECT_NE(&Psi(different).grid().table(), &one.grid().table());
}

TEST(LeastEntropy, SymmetricLevelsAreChosenByTheLower) {
  QuestPlusConfig config;
  config.function = ResponseFunction::logistic;
  config.levels = {{-30, -20, -10, 10, 20, 30}};
  config.threshold = {{-20, -10, 0, 10, 20}};
  config.slope = {{5}};
  config.guess = config.lapse = {{0.02}};
  config.stop_trials = 10;
  EXPECT_EQ(QuestPlus(config).next_level(level_stream(1, "s")), -10);
}

// Observers are drawn from the prior. 95 % intervals contain the true value in 95 %; by the
// cumulative sums of a grid of 49 values, in 93 %.
TEST(LeastEntropy, EstimatesWhatObserversHave) {
  PsiConfig config = test::heavier_at_200g(60);
  config.sensitivity = test::ratios(0.002, 0.05, 49);
  config.nuisance = {"indecision", "bias", "lapse"};
  const Procedure psi("s", config);
  int n_estimates = 0, n_inside = 0;
  double squares = 0;
  for (std::uint64_t i = 0; i < 200; ++i) {
    RandomStream draw(i, "person");
    const auto any = [&](const ValueGrid& grid) {
      return grid.values[draw.below(grid.values.size())];
    };
    const IndecisionParameters person{any(config.sensitivity), any(config.indecision),
                                      any(config.bias), any(config.lapse)};
    const double threshold = threshold_75_times_sensitivity / person.sensitivity;
    if (threshold < 30 || threshold > 200) continue;  // near an end of the grid
    const Estimate estimate = test::estimate_of(psi, i, [&](double level, RandomStream& stream) {
      return test::answer_of(person, level, stream);
    });
    if (!estimate.value) continue;
    ++n_estimates;
    n_inside += *estimate.low <= threshold && threshold <= *estimate.high ? 1 : 0;
    squares += std::pow(std::log(*estimate.value / threshold), 2);
  }
  EXPECT_GE(n_estimates, 90);
  EXPECT_GE(n_inside, 0.88 * n_estimates);
  EXPECT_LT(std::sqrt(squares / n_estimates), 0.35);
}

TEST(LeastEntropy, CoinsAndConstantAnswersHaveNoEstimate) {
  const Procedure choice("c", test::heavier_at_200g(60));
  const Procedure detection("d", test::detection_of_grams<PsiConfig>(60));
  const auto n_estimates = [](const Procedure& procedure, const auto& answer) {
    int n = 0;
    for (std::uint64_t i = 0; i < 100; ++i)
      n += test::estimate_of(procedure, i, answer).value ? 1 : 0;
    return n;
  };
  const auto coin = [](double, RandomStream& stream) {
    return response_of(static_cast<Choice>(stream.below(3)));
  };
  const auto yes_or_no = [](double, RandomStream& stream) { return Response{stream.coin(0.5)}; };
  const auto comparison = [](double, RandomStream&) { return response_of(Choice::comparison); };
  const auto none = [](double, RandomStream&) { return response_of(Choice::none); };
  EXPECT_LE(n_estimates(choice, coin), 5);
  EXPECT_LE(n_estimates(detection, yes_or_no), 5);
  for (const Procedure* procedure : {&choice, &detection}) {
    const auto ends_indeterminate = [&](const auto& answer) {
      const Estimate estimate = test::estimate_of(*procedure, 1, answer);
      return !estimate.value && !estimate.low && !estimate.high &&
             estimate.censored == Censored::indeterminate;
    };
    EXPECT_TRUE(ends_indeterminate(comparison));
    EXPECT_TRUE(ends_indeterminate(none));
  }
}

TEST(LeastEntropy, AThresholdBeyondTheGridHasABound) {
  const Procedure detection("d", test::detection_of_grams<PsiConfig>(60));
  const auto observer = [](double threshold) {
    return [threshold](double level, RandomStream& stream) {
      return Response{level + 15 * stream.normal() > threshold};
    };
  };
  const Estimate above = test::estimate_of(detection, 2, observer(392));
  EXPECT_EQ(above.censored, Censored::above);
  EXPECT_FALSE(above.value);
  EXPECT_FALSE(above.high);
  ASSERT_TRUE(above.low);
  EXPECT_NEAR(*above.low, 380, 15);
  EXPECT_EQ(test::estimate_of(detection, 2, observer(200)).censored, Censored::none);
}

// Cached and recomputed values must be equal: a replay may follow other trials than the session
// did.
TEST(LikelihoodTable, GivesTheSameWhetherItKeptItOrNot) {
  const GridSpace space = test::heavier_at_200g(40).space();
  const LikelihoodTable used(space);
  RandomStream draw(3, "trials");
  for (int trial = 0; trial < 200; ++trial) {
    const double level =
        draw.coin(0.5) ? space.levels[draw.below(space.levels.size())] : 600 * draw.uniform();
    const Response response = response_of(static_cast<Choice>(draw.below(3)));
    const auto once = used.log_likelihood(level, response);
    EXPECT_EQ(used.log_likelihood(level, response), once);
    EXPECT_EQ(*LikelihoodTable(space).log_likelihood(level, response), *once);
  }
}

TEST(LikelihoodTable, HasOneRowForAllGuessesAndLapses) {
  EXPECT_EQ(LikelihoodTable(test::heavier_at_200g(40).space()).n_alike(), 2);
  PsiConfig config = test::detection_of_grams<PsiConfig>(40);
  config.guess = {{0, 0.02}};
  config.lapse = {{0, 0.02, 0.04}};
  EXPECT_EQ(LikelihoodTable(config.space()).n_alike(), 6);
  config.nuisance = {"lapse"};
  EXPECT_EQ(LikelihoodTable(config.space()).n_alike(), 3);
}

TEST(LikelihoodTable, KeepsNoMoreThanItsMemoryAllows) {
  PsiConfig config = test::heavier_at_200g(40);
  config.sensitivity = test::ratios(0.001, 0.1, 2000);
  config.levels = {{0, 100}};
  const LikelihoodTable table(config.space());
  const std::size_t most = 4'000'000 / table.n_points();
  for (std::size_t i = 0; i < most; ++i)
    table.log_likelihood(static_cast<double>(i), {true, Choice::comparison});
  const auto first = table.log_likelihood(0, {true, Choice::comparison});
  EXPECT_EQ(table.log_likelihood(0, {true, Choice::comparison}), first);
  const auto beyond = table.log_likelihood(-1, {true, Choice::comparison});
  const auto again = table.log_likelihood(-1, {true, Choice::comparison});
  EXPECT_NE(again, beyond);
  EXPECT_EQ(*again, *beyond);
}

TEST(LeastEntropyConfig, NamesItsMistakes) {
  const PsiConfig good = test::heavier_at_200g(40);
  EXPECT_THAT(mistakes_of(good), ElementsAre());
  const auto with = [&](const auto& change) {
    PsiConfig config = good;
    change(config);
    return mistakes_of(config);
  };
  EXPECT_THAT(with([](auto& c) {
                c.threshold = {{1, 2}};
              }),
              ElementsAre(HasSubstr("threshold together with function \"indecision\"")));
  EXPECT_THAT(with([](auto& c) {
                c.levels = {{0, 10, 5}};
              }),
              ElementsAre("levels has 5 after 10, expected ascending values"));
  EXPECT_THAT(with([](auto& c) { c.sensitivity = {{0.1}}; }),
              ElementsAre(HasSubstr("sensitivity has one value")));
  EXPECT_THAT(with([](auto& c) { c.indecision = {{0}}; }), ElementsAre());  // forced choices
  EXPECT_THAT(with([](auto& c) { c.nuisance = {"slope"}; }),
              ElementsAre(HasSubstr("nuisance has \"slope\"")));
  EXPECT_THAT(with([](auto& c) {
                c.nuisance = {"sensitivity", "indecision", "bias", "lapse"};
              }),
              ElementsAre(HasSubstr("nuisance has every parameter")));
  EXPECT_THAT(with([](auto& c) { c.floor = 700; }),
              ElementsAre(HasSubstr("no level is between floor and ceiling")));
  EXPECT_THAT(with([](auto& c) { c.levels = test::spaced(0, 1, 30'000); }),
              ElementsAre(HasSubstr("too large a grid")));
  PsiConfig detection = test::detection_of_grams<PsiConfig>(10);
  detection.guess = {{0.5}};
  detection.lapse = {{0.1, 0.5}};
  EXPECT_THAT(mistakes_of(detection), ElementsAre(HasSubstr("a sum below 1")));
  EXPECT_THROW(Psi{detection}, InvalidConfig);
}

TEST(LeastEntropyConfig, IsReportedWithItsFunctionsParameters) {
  EXPECT_EQ(
      ProcedureKinds::described(Procedure("s", test::heavier_at_200g(40))),
      "Psi, function indecision, levels -180 to 600 (40 values) g, sensitivity 0.001 to 0.1 (25 "
      "values), indecision 0 to 3 (13 values), bias -0.5, 0, 0.5, lapse 0.02, 0.1, nuisance "
      "bias, lapse, at most 40 trials, interval width none");
}

TEST(LeastEntropyConfig, LevelsBesideAReferenceSuitTheTask) {
  EXPECT_TRUE(test::heavier_at_200g(40).check_beside(200).empty());
  EXPECT_THAT(test::heavier_at_200g(40).check_beside(180).at(0).text(),
              HasSubstr("levels has -180, expected above -180"));
  PsiConfig detection = test::detection_of_grams<PsiConfig>(10);
  EXPECT_TRUE(detection.check_beside(200).empty());
  detection.levels.values.front() = -10;
  EXPECT_THAT(detection.check_beside(200).at(0).text(), HasSubstr("function = \"indecision\""));
}

}  // namespace
}  // namespace heft
