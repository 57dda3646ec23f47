// Psych-DS (psych-ds.github.io): CSV files in data/ with keywords in their names, and JSON-LD that
// describes every variable.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "record/export/ExportFolder.h"

namespace heft {

namespace {
using nlohmann::ordered_json;

// Variables of several tables share one entry; differing descriptions are appended.
void add_variable(ordered_json& variables, const ExportColumn& column, const std::string& table) {
  for (ordered_json& variable : variables)
    if (variable["name"] == column.name) {
      if (variable["description"].get<std::string>().find(column.meaning) == std::string::npos)
        variable["description"] = fmt::format(
            "{}; {}: {}", variable["description"].get<std::string>(), table, column.meaning);
      return;
    }
  ordered_json variable{
      {"@type", "PropertyValue"}, {"name", column.name}, {"description", column.meaning}};
  if (!column.unit.empty()) variable["unitText"] = column.unit;
  if (!column.levels.empty()) {
    ordered_json levels = ordered_json::array();
    for (const std::string& level : levels_of(column)) levels.push_back(level);
    variable["levels"] = levels;
  }
  variables.push_back(std::move(variable));
}

std::string description(const ExportSource& source, const std::vector<ExportTable>& tables,
                        const ExportFolder& folder) {
  ordered_json variables = ordered_json::array();
  std::string what =
      "Perceived mass of virtual cubes, exported by heft " HEFT_VERSION ". Rows of each table: ";
  for (const ExportTable& table : tables) {
    what +=
        fmt::format("{}{} - {}", &table == tables.data() ? "" : "; ", table.name, table.meaning);
    for (const ExportColumn& column : source.columns(table))
      add_variable(variables, column, table.name);
  }
  const ordered_json json{{"@context", "https://schema.org/"},
                          {"@type", "Dataset"},
                          {"name", "heft"},
                          {"description", what + "." + folder.warning()},
                          {"variableMeasured", variables}};
  return json.dump(2, ' ', false, ordered_json::error_handler_t::replace) + '\n';
}
}  // namespace

void export_psych_ds(const ExportSource& source, ExportFolder& folder,
                     const std::function<void(double)>& progress) {
  const std::string script = analysis_script();
  const auto tables = write_tables(source, folder, "data/description-", "_data.csv", progress);
  folder.write_text("dataset_description.json", description(source, tables, folder));
  folder.write_text("README.md", readme_of("Psych-DS", folder));
  folder.write_text("analysis/analysis.R", script);
}

}  // namespace heft
