#include "analysis/display/EstimateTable.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <set>

namespace heft {

namespace {
Cell coordinate_cell(const StudyEstimate& estimate, std::string_view name) {
  const Coordinate* found = estimate.at(name);
  const std::optional<double> value = name == "reference_g" ? estimate.reference_g
                                      : found               ? found->value
                                                            : std::nullopt;
  return {estimate.text_at(name), value};
}

Cell shown(const std::optional<double>& value, const EstimateColumn& column, Censored censored) {
  constexpr double without_decimals = 1000;  // from here on, data do not support them
  Cell cell = number(value, std::abs(value.value_or(0)) < without_decimals ? column.decimals : 0);
  if (value && column.decimals == 0) cell.is_whole = true;
  if (column.field == Field::value && value && censored != Censored::indeterminate)
    cell.text = std::string(beyond_sign(censored)) + cell.text;
  return cell;
}

Cell cell_of(const StudyEstimate& estimate, const EstimateColumn& column) {
  const auto of_published = [&](auto member) {
    return number(
        estimate.published ? std::optional<double>(member(*estimate.published)) : std::nullopt,
        column.decimals);
  };
  switch (column.field) {
    case Field::value:
      return shown(estimate.value, column, estimate.censored);
    case Field::sd:
      return shown(estimate.sd, column, {});
    case Field::low:
      return shown(estimate.low, column, {});
    case Field::high:
      return shown(estimate.high, column, {});
    case Field::n:
      return count(estimate.n);
    case Field::n_trials:
      return count(estimate.n_trials);
    case Field::n_hits:
      return count(estimate.n_hits);
    case Field::pooled:
      return number(estimate.n_trials > 0
                        ? std::optional(100.0 * estimate.n_hits / estimate.n_trials)
                        : std::nullopt,
                    column.decimals);
    case Field::method:
      return word(std::string(estimate.method));
    case Field::censored:
      if (!estimate.value) return word("missing");
      return estimate.censored == Censored::none ? Cell{}
                                                 : word(std::string(name_of(estimate.censored)));
    case Field::why:
      return word(estimate.why);
    case Field::why_in_short:
      return word(estimate.why.substr(0, estimate.why.find(':')));
    case Field::identifiable:
      return flag(estimate.why.empty());
    case Field::published:
      return of_published([](const published::Figure& figure) { return figure.value; });
    case Field::published_sd:
      return estimate.published ? number(estimate.published->sd, column.decimals) : Cell{};
    case Field::published_n:
      return estimate.published ? count(published::n_participants) : Cell{};
  }
  return {};
}

// "soft_percent" of the condition "soft", where a column is spread over conditions.
std::string in_snake_case(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) {
    return std::isalnum(c) ? static_cast<char>(std::tolower(c)) : '_';
  });
  return text;
}

bool belongs(const StudyEstimate& estimate, const EstimateColumn& column) {
  return estimate.measure == column.measure &&
         (column.only.first.empty() || estimate.text_at(column.only.first) == column.only.second);
}

using Chosen = std::vector<const StudyEstimate*>;

// The estimates of the table's measures.
Chosen chosen_for(const EstimateTable& declared, const Estimates& estimates) {
  std::set<const Measure*> measures;
  for (const EstimateColumn& column : declared.columns) measures.insert(column.measure);
  Chosen chosen;
  for (const StudyEstimate& estimate : estimates)
    if (measures.contains(estimate.measure)) chosen.push_back(&estimate);
  return chosen;
}

// A spread column becomes one for each text of its coordinate.
std::vector<EstimateColumn> columns_for(const EstimateTable& declared, const Chosen& chosen) {
  std::vector<EstimateColumn> columns;
  for (const EstimateColumn& column : declared.columns) {
    if (column.spread.empty()) {
      columns.push_back(column);
      continue;
    }
    std::vector<std::string> texts;
    for (const StudyEstimate* estimate : chosen)
      if (estimate->measure == column.measure)
        if (std::string text = estimate->text_at(column.spread);
            std::ranges::find(texts, text) == texts.end())
          texts.push_back(std::move(text));
    for (const std::string& text : texts) {
      EstimateColumn one = column;
      one.name = in_snake_case(text) + column.name;
      one.heading = text + column.heading;
      one.json = column.json.empty() ? one.name : column.json + text;
      one.only = {column.spread, text};
      columns.push_back(std::move(one));
    }
  }
  return columns;
}
}  // namespace

Table table_of(const EstimateTable& declared, const Estimates& estimates) {
  const Chosen chosen = chosen_for(declared, estimates);
  const std::vector<EstimateColumn> columns = columns_for(declared, chosen);
  Table table{declared.name, declared.title, {}, {}, declared.note, declared.place, declared.json};
  for (const EstimateColumn& column : columns)
    table.columns.push_back({column.name, column.heading, column.json});
  const auto first = std::ranges::find_if(columns, &EstimateColumn::measure);
  const Measure* anchor = first == columns.end() ? nullptr : first->measure;
  const auto key_of = [&](const StudyEstimate& estimate) {
    std::string key;
    for (const EstimateColumn& column : columns)
      if (!column.measure) key += estimate.text_at(column.name) + '\n';
    return key;
  };
  std::map<std::string, std::size_t> places;
  for (const StudyEstimate* estimate : chosen) {
    if (estimate->measure != anchor || std::ranges::none_of(columns, [&](const auto& column) {
          return belongs(*estimate, column);
        }))
      continue;
    if (!places.try_emplace(key_of(*estimate), table.rows.size()).second) continue;
    std::vector<Cell>& row = table.rows.emplace_back(columns.size());
    for (std::size_t i = 0; i < columns.size(); ++i)
      if (!columns[i].measure) row[i] = coordinate_cell(*estimate, columns[i].name);
  }
  for (const StudyEstimate* estimate : chosen) {
    const auto place = places.find(key_of(*estimate));
    if (place == places.end()) continue;
    for (std::size_t i = 0; i < columns.size(); ++i)
      if (columns[i].measure && belongs(*estimate, columns[i]))
        table.rows[place->second][i] = cell_of(*estimate, columns[i]);
  }
  return table;
}

Table list_of(const Estimates& estimates) {
  Table table{"estimates",
              "All estimates",
              {{"measure", "measure"},
               {"unit", "unit"},
               {"task", "task"},
               {"condition", "condition"},
               {"reference_g", "reference g"},
               {"participant", "participant"},
               {"at", "at"},
               {"value", "value"},
               {"sd", "SD"},
               {"low", "low"},
               {"high", "high"},
               {"n", "n"},
               {"n_trials", "trials"},
               {"n_hits", "of them"},
               {"method", "method"},
               {"censored", "censored"},
               {"why", "why"},
               {"published", "published"}},
              {},
              "one row for each figure; the table of measures says what each is",
              TablePlace::csv,
              "estimates[]"};
  for (const StudyEstimate& estimate : estimates) {
    std::string at;
    for (const Coordinate& coordinate : estimate.by)
      at += fmt::format("{}{}={}", at.empty() ? "" : "; ", coordinate.name, coordinate.text);
    const auto cell = [&](Field field) {
      return cell_of(estimate, {"", "", estimate.measure, field, 4});
    };
    table.rows.push_back({word(std::string(estimate.measure->name)),
                          word(std::string(estimate.measure->unit)), word(estimate.task),
                          word(estimate.condition), coordinate_cell(estimate, "reference_g"),
                          word(estimate.participant), word(at), cell(Field::value), cell(Field::sd),
                          cell(Field::low), cell(Field::high), cell(Field::n),
                          cell(Field::n_trials), cell(Field::n_hits), cell(Field::method),
                          cell(Field::censored), cell(Field::why), cell(Field::published)});
  }
  return table;
}

Table measures_in(const Estimates& estimates) {
  Table table{"measures",
              "Measures: what each estimate is",
              {{"measure", "measure"}, {"unit", "unit"}, {"meaning", "meaning"}},
              {},
              "",
              TablePlace::run_only};
  std::set<const Measure*> listed;
  for (const StudyEstimate& estimate : estimates)
    if (listed.insert(estimate.measure).second)
      table.rows.push_back({word(std::string(estimate.measure->name)),
                            word(std::string(estimate.measure->unit)),
                            word(std::string(estimate.measure->meaning))});
  return table;
}

}  // namespace heft
