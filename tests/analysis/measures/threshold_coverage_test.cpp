// How often the intervals of thresholds and criteria contain the true values: see results/coverage.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "analysis/Folds.h"
#include "analysis/MadeUpChoosers.h"
#include "analysis/measures/Sensitivity.h"
#include "inference/Coverage.h"

namespace heft {
namespace {

using namespace made_up;

std::optional<Interval> interval_of(const std::optional<MixedFigure>& figure) {
  return figure ? std::optional(Interval{figure->low.value_or(0), figure->high.value_or(1e9)})
                : std::nullopt;
}

// One kind of study. Default: 13 people with a threshold of 150 g and a criterion of 1 SD.
struct Cell {
  int n_people = 13;
  Population population{150};
  double reference_g = 200;
};

struct FitCoverage {
  Coverage threshold{}, indecision{}, own{};  ///< own: each person's sensitivity
  double log_bias = 0;                        ///< of the threshold, mean over studies
};

FitCoverage fit_coverage(const Cell& cell, int studies) {
  RandomStream stream(17, "thresholds", static_cast<std::uint64_t>(cell.n_people));
  FitCoverage found;
  for (int i = 0; i < studies; ++i) {
    std::vector<Chooser> people;
    const auto rows = sensitivities_of(
        study(cell.n_people, cell.population, {paired_at(cell.reference_g)}, stream, &people));
    const MixedFit& fit = rows.at(0).fit;
    for (std::size_t k = 0; k < people.size(); ++k)
      if (const OwnSensitivity* own = fit.own(std::to_string(100 + k)))
        found.own.add(Interval{own->low.value_or(-1e9), own->high.value_or(1e9)},
                      people[k].sensitivity_per_g);
    found.threshold.add(interval_of(fit.threshold_75_g), cell.population.threshold_75_g);
    found.indecision.add(interval_of(fit.indecision), cell.population.indecision);
    if (fit.threshold_75_g)
      found.log_bias += std::log(fit.threshold_75_g->value / cell.population.threshold_75_g);
  }
  found.log_bias /= found.threshold.n_given();
  return found;
}

std::string in_words(const Cell& cell) {
  const Population& people = cell.population;
  std::string text = fmt::format("{} people, threshold {} g", cell.n_people, people.threshold_75_g);
  if (people.lapse_rate != 0.02) text += fmt::format(", lapse rate {}", people.lapse_rate);
  if (people.correlation != 0) text += fmt::format(", correlation {}", people.correlation);
  if (people.growth != 1) text += fmt::format(", criterion grows {:.2g}-fold", people.growth);
  return text + fmt::format(", spread {}", people.spread);
}

FitCoverage measured(const Cell& cell, int studies) {
  const FitCoverage found = fit_coverage(cell, studies);
  fmt::print(
      "{}: {:.2f} % of {:.1f} % given; indecision {}: {:.2f} %; of each person {:.2f} %; "
      "thresholds {:+.1f} % off\n",
      in_words(cell), found.threshold.percent(), found.threshold.given_percent(),
      cell.population.indecision, found.indecision.percent(), found.own.percent(),
      100 * std::expm1(found.log_bias));
  return found;
}

// @param fewest_own percent of each person's own intervals that hold their threshold: in them the
//   criteria and the lapse rate of the population count as known
void expect_as_printed(const Cell& cell, int studies, double fewest_own = 91) {
  const FitCoverage found = measured(cell, studies);
  expect_95(found.threshold, studies);
  expect_95(found.indecision, studies);
  EXPECT_GE(found.threshold.given_percent(), 95) << in_words(cell);
  EXPECT_EQ(found.indecision.given_percent(), 100);
  EXPECT_GE(found.own.percent(), fewest_own - by_chance_percent(found.own.n_given()));
  EXPECT_LE(found.own.percent(), 98 + by_chance_percent(found.own.n_given()));
}

TEST(CoverageOf, Sensitivities) {
  for (const Cell& cell :
       {Cell{13, {150, 0}}, Cell{13, {150}}, Cell{13, {150, 0.3, 0.4}}, Cell{13, {50}, 15},
        Cell{13, {600}, 800}, Cell{40, {150}}, Cell{13, {150, 0.3, 2}}, Cell{40, {150, 0.3, 2}}})
    expect_as_printed(cell, n_studies(20));
}

TEST(CoverageOf, ThresholdsOfFivePeople) {
  for (const double spread : {0.3, 0.6, 0.9})
    for (const double indecision : {1.0, 2.0})
      expect_as_printed({5, {150, spread, indecision}}, n_studies(2), 80);
}

TEST(CoverageOf, ThresholdsByLapseRate) {
  for (const int n_people : {5, 13, 40})
    for (const double rate : {0.0, 0.05, 0.1})
      expect_as_printed({n_people, {.threshold_75_g = 150, .lapse_rate = rate}}, n_studies(2), 88);
}

TEST(CoverageOf, ThresholdsOfPeopleWhoDiffer) {
  for (const int n_people : {13, 40}) {
    for (const double spread : {0.6, 0.9})
      expect_as_printed({n_people, {150, spread}}, n_studies(2));
    for (const double correlation : {-0.5, 0.5})
      expect_as_printed({n_people, {.threshold_75_g = 150, .correlation = correlation}},
                        n_studies(2));
  }
}

// The model's criteria are constant. If they drift, thresholds are up to a fifth too large, and the
// narrow intervals of many people miss the true value. Predictive checks flag it:
// tests/inference/checks.
TEST(CoverageOf, ThresholdsUnderDrift) {
  for (const int n_people : {5, 13, 40})
    for (const double growth : {1.0 / 3, 3.0}) {
      const Cell cell{n_people, {.threshold_75_g = 150, .growth = growth}};
      const int studies = n_studies(2);
      const FitCoverage found = measured(cell, studies);
      EXPECT_EQ(found.threshold.given_percent(), 100);
      EXPECT_NEAR(found.log_bias, 0.1, 0.1 + 1 / std::sqrt(n_people * studies));
    }
}

}  // namespace
}  // namespace heft
