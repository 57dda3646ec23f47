// How often comparisons were answered in one of two ways, by the difference in mass: the estimates,
// their table and their chart.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "analysis/measures/Section.h"
#include "inference/Fit.h"

namespace heft {

/// Each participant's two kinds of answers by level; the second kind is counted.
using AnswersByPerson = std::map<std::string, AnswersByLevel>;

/// Each participant's estimates together that are of one reference, condition and measure.
inline std::vector<std::vector<const StudyEstimate*>> together(const Estimates& own) {
  std::map<std::tuple<std::optional<double>, std::string, std::string_view>,
           std::vector<const StudyEstimate*>>
      groups;
  for (const StudyEstimate& one : own)
    groups[{one.reference_g, one.condition, one.measure->name}].push_back(&one);
  std::vector<std::vector<const StudyEstimate*>> all;
  for (auto& [key, people] : groups) all.push_back(std::move(people));
  return all;
}

struct ShareByLevel {
  const Measure& share;
  std::string name;  ///< of the chart; the table is NAME_by_level
  std::string title, caption;
  std::string hits;       ///< "chosen": the word for an answer that is counted
  std::string note = {};  ///< below the table

  void put(Estimates& all, const Compared& compared, const AnswersByPerson& people) const;
  EstimateTable table() const;
  ChartSpec chart() const;
};

inline void ShareByLevel::put(Estimates& all, const Compared& compared,
                              const AnswersByPerson& people) const {
  std::map<double, Tallies> by_level;
  for (const auto& [participant, answers] : people)
    for (const auto& [level_g, n] : answers)
      by_level[level_g][participant] = {static_cast<int>(n[1]), static_cast<int>(n[0] + n[1])};
  for (const auto& [level_g, tallies] : by_level) {
    StudyEstimate& one = all.emplace_back(rate_estimate(share, rate_of(tallies)));
    one.task = "comparison";
    one.condition = compared.condition;
    one.reference_g = compared.reference_g;
    one.by = {at("level_g", level_g)};
  }
}

inline EstimateTable ShareByLevel::table() const {
  EstimateTable table{
      name + "_by_level",
      title,
      {key_column("reference_g", "reference g"), key_column("condition", "condition"),
       key_column("level_g", "difference g"), column(share, Field::n_trials, "n_trials", "trials"),
       column(share, Field::n_hits, "n_" + hits, hits),
       column(share, Field::value, hits + "_percent", "%")},
      note,
      TablePlace::csv};
  add_interval(table.columns, share, "low_percent", "high_percent", 1);
  return table;
}

inline ChartSpec ShareByLevel::chart() const {
  return {.name = name,
          .title = title,
          .caption = caption,
          .csv = name + "_by_level.csv",
          .importance = 38,
          .series = {{&share}},
          .x = "level_g",
          .panels = {"reference_g", "condition"},
          .x_label = "difference (g)",
          .y_label = "% of trials",
          .axes = "set yrange [0:100]\n"};
}

}  // namespace heft
