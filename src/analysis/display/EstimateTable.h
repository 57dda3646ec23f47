// Tables of estimates. A table is a declaration: which coordinates make a row, and which measures
// are its columns.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "analysis/dataset/StudyEstimate.h"
#include "analysis/display/Table.h"

namespace heft {

/// The field of an estimate that a cell shows.
enum class Field {
  value,
  sd,
  low,
  high,
  n,
  n_trials,
  n_hits,
  pooled,  ///< hits of all trials together, in percent
  method,
  censored,
  why,
  why_in_short,  ///< up to the first colon
  identifiable,  ///< a flag: there is no `why`
  published,
  published_sd,
  published_n,
};

/// One column: a coordinate of the row, or a measure.
struct EstimateColumn {
  std::string name;                  ///< in CSV; empty: omitted
  std::string heading;               ///< in text and HTML; empty: omitted
  const Measure* measure = nullptr;  ///< null: the coordinate of this name
  Field field = Field::value;
  int decimals = 1;
  std::string json{};  ///< see Column; empty: `name`
  /// Only estimates with this coordinate.
  std::pair<std::string_view, std::string> only{};
  /// A column for each text of this coordinate, which precedes the name.
  std::string_view spread{};
};

/// A coordinate as a column.
inline EstimateColumn key_column(std::string name, std::string heading) {
  return {std::move(name), std::move(heading)};
}
inline EstimateColumn column(const Measure& measure, Field field, std::string name,
                             std::string heading = "", int decimals = 1, std::string json = "") {
  return {std::move(name), std::move(heading), &measure, field, decimals, std::move(json)};
}
/// A column that only JSON has.
inline EstimateColumn json_column(const Measure& measure, Field field, std::string json) {
  return {"", "", &measure, field, 1, std::move(json)};
}
/// The columns LOW and HIGH.
inline void add_interval(std::vector<EstimateColumn>& columns, const Measure& measure,
                         std::string low, std::string high, int decimals = 1) {
  columns.push_back(column(measure, Field::low, std::move(low), "95 % low", decimals));
  columns.push_back(column(measure, Field::high, std::move(high), "high", decimals));
}

/// The columns N (of trials), median_UNIT and the quartiles.
inline void add_quartiles(std::vector<EstimateColumn>& columns, const Measure& measure) {
  const std::string unit(measure.unit);
  columns.push_back(column(measure, Field::n_trials, "n", "n"));
  columns.push_back(column(measure, Field::value, "median_" + unit, "median", 2));
  columns.push_back(column(measure, Field::low, "lower_quartile_" + unit, "25 %", 2));
  columns.push_back(column(measure, Field::high, "upper_quartile_" + unit, "75 %", 2));
}

struct EstimateTable {
  std::string name, title;
  std::vector<EstimateColumn> columns;
  std::string note{};
  TablePlace place = TablePlace::results;
  std::string json{};
  bool participants = false;  ///< of each participant; otherwise over all
};

/// The rows in the order of the first measure's estimates.
Table table_of(const EstimateTable& declared, const Estimates& estimates);

/// All of them, a row each.
Table list_of(const Estimates& estimates);

/// What each measure means.
Table measures_in(const Estimates& estimates);

}  // namespace heft
