// How thresholds compare: from one reference to the next, along all references of a condition, and
// between conditions.
#include <fmt/format.h>

#include <cmath>
#include <map>

#include "analysis/measures/Sensitivity.h"

namespace heft {

namespace {
constexpr Measure ratio{"threshold_ratio", "", "ratio of thresholds",
                        "threshold at a reference over the threshold at the next lighter one"};
constexpr Measure smallest_ratio{"smallest_threshold_ratio", "", "smallest ratio",
                                 "smallest ratio of thresholds that 80 % of studies of this size "
                                 "and spread would distinguish from 1"};
constexpr Measure condition_ratio{
    "threshold_condition_ratio", "", "ratio of thresholds",
    "threshold in a condition over the threshold in another, at the same reference"};
constexpr Measure exponent{
    "threshold_exponent", "", "exponent",
    "slope of log threshold on log reference: 0 if thresholds are equal, 1 if proportional"};
constexpr Measure smallest_exponent{
    "smallest_threshold_exponent", "", "smallest exponent",
    "smallest exponent that 80 % of studies of this size and spread would distinguish from 0"};

using Rows = std::vector<const ReferenceSensitivity*>;

StudyEstimate estimate_at(const Measure& measure, const ReferenceSensitivity& row, int n) {
  StudyEstimate estimate{&measure, "comparison", row.compared.condition};
  estimate.reference_g = row.compared.reference_g;
  estimate.n = n;
  estimate.method = "infinitesimal jackknife over participants";
  estimate.as_published = row.as_published;
  return estimate;
}

// Adds the ratio of the threshold of `row` to that of `below`.
void put_ratio(Estimates& all, const Measure& measure, const ReferenceSensitivity& row,
               const ReferenceSensitivity& below, Coordinate where) {
  const Contrast contrast =
      threshold_contrast(std::array{&below.fit, &row.fit}, std::array{-1.0, 1.0});
  const auto [low, high] = contrast.interval();
  StudyEstimate& one = all.emplace_back(estimate_at(measure, row, contrast.n));
  one.by = {where};
  one.value = std::exp(contrast.value);
  one.set(Interval{std::exp(low), std::exp(high)});
  StudyEstimate& smallest = all.emplace_back(estimate_at(smallest_ratio, row, contrast.n));
  smallest.by = {std::move(where)};
  smallest.value = std::exp(contrast.smallest_effect());
}

void put_exponent(Estimates& all, const Rows& rows) {
  std::vector<const MixedFit*> fits;
  std::vector<double> references_g;
  for (const ReferenceSensitivity* row : rows)
    if (row->is_of_people() && row->compared.reference_g > 0) {
      fits.push_back(&row->fit);
      references_g.push_back(row->compared.reference_g);
    }
  if (fits.size() < 2) return;
  const Contrast slope = threshold_exponent(fits, references_g);
  StudyEstimate& one = all.emplace_back(estimate_at(exponent, *rows.front(), slope.n));
  one.reference_g.reset();
  one.value = slope.value;
  one.set(slope.interval());
  StudyEstimate& smallest =
      all.emplace_back(estimate_at(smallest_exponent, *rows.front(), slope.n));
  smallest.reference_g.reset();
  smallest.value = slope.smallest_effect();
}
}  // namespace

void put_threshold_contrasts(Estimates& all, std::span<const ReferenceSensitivity> rows) {
  std::map<std::pair<std::string, bool>, Rows> by_condition;
  std::map<double, Rows> by_reference;
  for (const ReferenceSensitivity& row : rows) {
    by_condition[{row.compared.condition, row.as_published}].push_back(&row);
    by_reference[row.compared.reference_g].push_back(&row);
  }
  for (const auto& [condition, of_condition] : by_condition) {
    for (std::size_t i = 1; i < of_condition.size(); ++i)
      if (of_condition[i - 1]->is_of_people() && of_condition[i]->is_of_people())
        put_ratio(all, ratio, *of_condition[i], *of_condition[i - 1],
                  at("lighter_reference_g", of_condition[i - 1]->compared.reference_g));
    put_exponent(all, of_condition);
  }
  for (const auto& [reference_g, of_reference] : by_reference)
    for (std::size_t i = 0; i < of_reference.size(); ++i)
      for (std::size_t k = i + 1; k < of_reference.size(); ++k)
        if (of_reference[i]->is_of_people() && of_reference[k]->is_of_people())
          put_ratio(all, condition_ratio, *of_reference[k], *of_reference[i],
                    {"other_condition", of_reference[i]->compared.condition});
}

EstimateTable threshold_ratio_table() {
  EstimateTable table{
      "threshold_ratios",
      "Ratios of thresholds",
      {key_column("reference_g", "reference g"), key_column("condition", "condition"),
       key_column("lighter_reference_g", "over reference g"),
       key_column("other_condition", "over condition"), column(ratio, Field::n, "n", "n")}};
  for (const auto& [measure, prefix] :
       {std::pair(&ratio, ""), std::pair(&condition_ratio, "condition_")}) {
    const std::string name(prefix);
    table.columns.push_back(column(*measure, Field::value, name + "ratio",
                                   measure == &ratio ? "ratio" : "between conditions", 2));
    add_interval(table.columns, *measure, name + "ratio_low", name + "ratio_high", 2);
  }
  table.columns.push_back(column(smallest_ratio, Field::value, "smallest_ratio", "detectable", 2));
  table.note =
      "threshold at a reference over that at the next lighter one, or in a condition over that in "
      "another; participants are compared with themselves where they took part in both. "
      "Detectable: the smallest ratio that 80 % of studies of this size and spread would find.";
  return table;
}

EstimateTable threshold_exponent_table() {
  return {"threshold_exponents",
          "Growth of thresholds with the reference",
          {key_column("condition", "condition"), column(exponent, Field::n, "n", "n"),
           column(exponent, Field::value, "exponent", "exponent", 2),
           column(exponent, Field::low, "low", "95 % low", 2),
           column(exponent, Field::high, "high", "high", 2),
           column(smallest_exponent, Field::value, "smallest_exponent", "detectable", 2)},
          "exponent of threshold ~ reference^exponent: 0 if thresholds are equal, 1 if they are "
          "proportional to the reference (Weber's law). Detectable: the smallest exponent that "
          "80 % of studies of this size and spread would find.",
          TablePlace::results,
          "threshold_exponents[]"};
}

}  // namespace heft
