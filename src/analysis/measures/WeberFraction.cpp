// Weber fractions, and how thresholds grow with the reference, of any task.
#include <cmath>
#include <map>
#include <vector>

#include "analysis/measures/Sensitivity.h"

namespace heft {

namespace {
using Thresholds = std::vector<const StudyEstimate*>;

std::optional<double> slope_of_logs(const Thresholds& thresholds) {
  std::vector<double> x, y;
  for (const StudyEstimate* one : thresholds)
    if (one->value) {
      x.push_back(std::log(*one->reference_g));
      y.push_back(std::log(*one->value));
    }
  if (x.size() < 2) return std::nullopt;
  return slope(x, y);
}
}  // namespace

std::optional<StudyEstimate> weber_fraction_of(const StudyEstimate& threshold,
                                               const Measure& fraction) {
  if (*threshold.reference_g <= 0) return std::nullopt;
  StudyEstimate of = threshold;
  of.measure = &fraction;
  for (auto* figure : {&of.value, &of.low, &of.high})
    if (*figure) **figure /= *of.reference_g;
  return of;
}

void add_weber_fraction(std::vector<EstimateColumn>& columns, const Measure& fraction) {
  columns.push_back(column(fraction, Field::value, "weber_fraction", "Weber fraction", 3));
  columns.push_back(column(fraction, Field::low, "weber_fraction_low"));
  columns.push_back(column(fraction, Field::high, "weber_fraction_high"));
}

Estimates own_exponents(const Estimates& thresholds, const Measure& threshold,
                        const Measure& exponent) {
  std::map<std::pair<std::string, std::string>, Thresholds> by_person;  // and condition
  for (const StudyEstimate& one : thresholds)
    if (one.measure == &threshold && *one.reference_g > 0)
      by_person[{one.condition, one.participant}].push_back(&one);
  Estimates all;
  for (const auto& [key, own] : by_person) {
    if (own.size() < 2) continue;
    StudyEstimate& one = all.emplace_back(StudyEstimate{&exponent, own.front()->task, key.first});
    one.participant = key.second;
    one.value = slope_of_logs(own);
    one.n = 1;
    for (const StudyEstimate* threshold_of : own) one.n_trials += threshold_of->n_trials;
    if (!one.value) one.why = "a threshold at fewer than two references";
  }
  return all;
}

EstimateTable exponent_table(std::string name, std::string title, const Measure& exponent) {
  const std::string json = name + "[]";
  return {std::move(name),
          std::move(title),
          {key_column("condition", "condition"), column(exponent, Field::n, "n", "n"),
           column(exponent, Field::value, "exponent", "exponent", 2),
           column(exponent, Field::sd, "sd", "SD", 2),
           column(exponent, Field::low, "low", "95 % low", 2),
           column(exponent, Field::high, "high", "high", 2),
           column(exponent, Field::why, "why", "no exponent: why")},
          "exponent of threshold ~ reference^exponent of each participant, mean over participants "
          "with Student's t interval: 0 if thresholds are equal, 1 if Weber fractions are",
          TablePlace::results,
          json};
}

EstimateTable own_exponent_table(std::string name, std::string title, const Measure& exponent) {
  EstimateTable table{
      std::move(name),
      std::move(title),
      {key_column("condition", "condition"), key_column("participant", "participant"),
       column(exponent, Field::n_trials, "n_trials", "trials"),
       column(exponent, Field::value, "exponent", "exponent", 2),
       column(exponent, Field::why, "why", "no exponent: why")},
      "",
      TablePlace::csv};
  table.participants = true;
  return table;
}

}  // namespace heft
