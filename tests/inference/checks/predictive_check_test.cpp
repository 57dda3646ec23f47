// Predictive checks: a study that follows the model passes, one that does not is flagged.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "inference/Coverage.h"
#include "inference/checks/PredictiveCheck.h"
#include "psychophysics/UpDown.h"

namespace heft {
namespace {

MixedFit fit_of_truth() {
  MixedFit fit;
  fit.n = 40;
  fit.sensitivity = MixedFigure{0.6745 / 150};
  fit.threshold_75_g = MixedFigure{150};
  fit.indecision = MixedFigure{1};
  fit.lapse = MixedFigure{0.02};
  fit.sd_log_sensitivity = fit.sd_log_indecision = 0.3;
  fit.correlation = 0;
  fit.sd_bias = 0.2;
  return fit;
}

StaircaseRun staircase(double start_g) {
  UpDownConfig config;
  config.start = start_g;
  config.step = 60;
  config.halve_every = 2;
  config.floor = 0;
  config.ceiling = 800;
  config.stop_reversals = 8;
  config.stop_trials = 60;
  return {std::make_shared<const Procedure>("s", config)};
}

// 12 catch trials each, and staircases from above and below.
// @param growth of the criterion from the first trial to the last; 1: as in the model
std::vector<PersonRuns> study(double growth, int n_people, std::uint64_t seed) {
  RandomStream stream(seed, "predictive checks");
  std::vector<PersonRuns> people;
  for (int i = 0; i < n_people; ++i) {
    const double s = 0.6745 / 150 * std::exp(0.3 * stream.normal());
    const double tau = std::exp(0.3 * stream.normal()), bias = 0.2 * stream.normal();
    PersonRuns person{{staircase(500), staircase(60)}, 12, 0};
    const auto choose = [&](double level_g, double part) {
      const double grown = tau * std::pow(growth, part - 0.5);
      const IndecisionShares shares =
          indecision_shares({s, grown, stream.coin(0.5) ? bias : -bias, 0.02}, level_g);
      const double u = stream.uniform();
      return u < shares.reference                 ? Choice::reference
             : u < shares.reference + shares.none ? Choice::none
                                                  : Choice::comparison;
    };
    for (StaircaseRun& run : person.staircases)
      for (Procedure procedure = *run.before; !procedure.finished();) {
        const double level_g = procedure.next_level(stream);
        const Choice choice = choose(level_g, std::min(1.0, procedure.n_trials() / 25.0));
        procedure.respond(response_of(choice), level_g);
        run.choices.push_back({level_g, choice});
      }
    for (int k = 0; k < person.n_catch; ++k)
      person.n_catch_none += choose(0, k / 12.0) == Choice::none ? 1 : 0;
    people.push_back(person);
  }
  return people;
}

// Answers as heft analyse takes them from a log; sides are equally likely.
MixedFit fitted(const std::vector<PersonRuns>& people) {
  AnswersByPerson answers;
  RandomStream stream(5, "sides");
  for (std::size_t i = 0; i < people.size(); ++i) {
    AnswersByLevel& own = answers[std::to_string(100 + i)];
    for (const StaircaseRun& run : people[i].staircases)
      for (const MadeChoice& made : run.choices) {
        const double side = stream.coin(0.5) ? 1 : -1;
        const std::size_t up = made.choice == Choice::comparison ? 2 : 0;
        own[side * made.level_g][made.choice == Choice::none ? 1 : side > 0 ? up : 2 - up] += 1;
      }
    const int n_chosen = people[i].n_catch - people[i].n_catch_none;
    own[0][1] += people[i].n_catch_none;
    own[0][0] += n_chosen / 2;
    own[0][2] += n_chosen - n_chosen / 2;
  }
  return fit_mixed_indecision(answers);
}

const std::vector<double> edges_g{40, 90, 150, 220, 320};

// Of a single check.
double p_of(const PredictiveCheck& check) {
  return joint_p(std::span(&check, 1)).front();
}

TEST(PredictiveCheck, OfTheModelItselfHasUniformP) {
  const int studies = n_studies(40);
  int n_below_05 = 0, n_below_half = 0;
  for (int i = 0; i < studies; ++i) {
    const auto seed = static_cast<std::uint64_t>(100 + i);
    const double p = p_of(check_predictions(fit_of_truth(), study(1, 12, seed), edges_g));
    EXPECT_GT(p, 0);
    n_below_05 += p < 0.05 ? 1 : 0;
    n_below_half += p < 0.5 ? 1 : 0;
  }
  EXPECT_LE(n_below_05, 0.05 * studies + 3 * std::sqrt(0.05 * studies));
  EXPECT_NEAR(n_below_half, 0.5 * studies, 3 * std::sqrt(0.25 * studies));
}

TEST(PredictiveCheck, DistinguishesAModelThatHoldsFromOthers) {
  const int studies = n_studies(6);
  for (const auto& [growth, n_people, fewest, most] :
       {std::tuple{1.0, 40, 0.0, 0.05}, {3.0, 40, 0.8, 1.0}, {3.0, 13, 0.35, 1.0}}) {
    int n_flagged = 0;
    for (int i = 0; i < studies; ++i) {
      const auto people = study(growth, n_people, 500 + static_cast<std::uint64_t>(i));
      const MixedFit fit = fitted(people);
      ASSERT_TRUE(fit.identifiable()) << fit.why;
      const PredictiveCheck check = check_predictions(fit, people, edges_g);
      n_flagged += p_of(check) < 0.05 ? 1 : 0;
      std::cout << growth << ": p " << p_of(check) << ", " << check.farthest().name << " "
                << check.farthest().deviation() << " SD\n";
    }
    std::cout << n_people << " people, criterion grows " << growth
              << "-fold: " << 100.0 * n_flagged / studies << " % flagged\n";
    const double chance = 3 * std::sqrt(0.05 * 0.95 / studies);
    EXPECT_GE(n_flagged, (fewest - chance) * studies) << growth;
    EXPECT_LE(n_flagged, (most + chance) * studies) << growth;
  }
}

// A check of 100 studies whose farthest figures deviate by 0.01, 0.02 ... 1 SD.
PredictiveCheck check_with(double seen_deviation) {
  PredictiveCheck check;
  check.figures.push_back({.name = "a figure", .seen = seen_deviation, .mean = 0, .sd = 1});
  for (int i = 1; i <= 100; ++i) check.farthest_of_studies.push_back(0.01 * i);
  return check;
}

TEST(PredictiveCheck, CanRejectOneOfManyModelsHoweverFewStudiesItHas) {
  std::vector<PredictiveCheck> checks(30, check_with(0.5));
  checks[7] = check_with(-8);
  const std::vector<double> all = joint_p(checks);
  for (std::size_t i = 0; i < all.size(); ++i)
    EXPECT_DOUBLE_EQ(all[i], i == 7 ? 1.0 / 101 : 52.0 / 101) << i;
}

TEST(PredictiveCheck, JudgesAllModelsByTheFarthestFigureOfAny) {
  PredictiveCheck wide = check_with(0.5), narrow = check_with(0.5);
  for (double& farthest : wide.farthest_of_studies) farthest *= 3;
  const std::vector<double> all = joint_p(std::array{wide, narrow});
  EXPECT_DOUBLE_EQ(all[0], 85.0 / 101);  // 0.03 i is 0.5 or more for i from 17 on
  EXPECT_DOUBLE_EQ(all[1], all[0]);
  narrow.farthest_of_studies.resize(50);
  EXPECT_DOUBLE_EQ(joint_p(std::array{wide, narrow})[1], 35.0 / 51);  // of 50 studies
  EXPECT_TRUE(joint_p({}).empty());
}

// Three references a study: at most one study in 20 is flagged.
TEST(PredictiveCheck, FlagsFewStudiesOfSeveralModelsThatHold) {
  const int studies = n_studies(20);
  int n_flagged = 0;
  for (int i = 0; i < studies; ++i) {
    std::vector<PredictiveCheck> checks;
    for (std::uint64_t row = 0; row < 3; ++row)
      checks.push_back(check_predictions(
          fit_of_truth(), study(1, 12, 3000 + 3 * static_cast<std::uint64_t>(i) + row), edges_g,
          1 + row));
    n_flagged += std::ranges::min(joint_p(checks)) < 0.05 ? 1 : 0;
  }
  std::cout << 100.0 * n_flagged / studies << " % flagged\n";
  EXPECT_LE(n_flagged, 0.05 * studies + 3 * std::sqrt(0.05 * studies));
}

TEST(PredictiveCheck, RunsStaircasesThatDidNotEndAsLong) {
  auto people = study(1, 6, 9);
  for (PersonRuns& person : people)
    for (StaircaseRun& run : person.staircases) run.choices.resize(5);
  const PredictiveCheck check = check_predictions(fit_of_truth(), people, edges_g);
  for (const PredictedFigure& figure : check.figures) EXPECT_NE(figure.name, "number of trials");
}

// All levels in one range, as where every trial had the same difference.
TEST(PredictiveCheck, NeedsNoEdges) {
  const auto people = study(1, 6, 9);
  const PredictiveCheck check = check_predictions(fit_of_truth(), people, {});
  EXPECT_EQ(check.by_level.size(), 1u);
  EXPECT_EQ(check.figures.at(0).name, "share of \"no difference\"");
}

TEST(PredictiveCheck, NamesRangesByTheirEdges) {
  const auto figures =
      check_predictions(fit_of_truth(), study(1, 6, 9), std::vector{40.0, 90.0}).figures;
  const auto is_named = [&](const std::string& name) {
    return std::ranges::count(figures, name, &PredictedFigure::name) == 1;
  };
  for (const char* where : {"up to 40 g", "from 40 to 90 g", "from 90 g"})
    EXPECT_TRUE(is_named(std::string("share of \"no difference\" ") + where)) << where;
}

TEST(PredictiveCheck, IsTheSameForTheSameSeed) {
  const auto people = study(1, 6, 9);
  const auto p = [&](std::uint64_t seed) {
    return check_predictions(fit_of_truth(), people, edges_g, seed).figures.at(0).mean;
  };
  EXPECT_EQ(p(1), p(1));
  EXPECT_NE(p(1), p(2));
}

}  // namespace
}  // namespace heft
