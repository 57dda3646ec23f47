// A folder for a quick study's files, and reading them back.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "base/files/TextFile.h"
#include "results/Study.h"

namespace heft {

/// A CSV file whose cells hold no quotes or commas, but for the command at the end.
struct StudyCsv {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;

  /// All cells of a column that are not empty; fails the test for one that is no finite number.
  std::vector<double> numbers(const std::string& column) const {
    std::vector<double> values;
    const auto at = std::find(columns.begin(), columns.end(), column);
    if (at == columns.end()) {
      ADD_FAILURE() << "no column " << column;
      return values;
    }
    for (const auto& row : rows) {
      const std::string& cell = row.at(static_cast<std::size_t>(at - columns.begin()));
      if (cell.empty()) continue;
      const auto value = number_in(cell);
      EXPECT_TRUE(value) << column << ": " << cell;
      if (value) values.push_back(*value);
    }
    return values;
  }
};

class StudyFolder {
 public:
  explicit StudyFolder(const std::string& study)
      : path_(std::filesystem::path(testing::TempDir()) / ("heft_bench_" + study)) {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~StudyFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  StudyFolder(const StudyFolder&) = delete;
  StudyFolder& operator=(const StudyFolder&) = delete;

  StudyOptions options() const { return {path_.string(), "heft bench --quick", true}; }

  std::string text(const std::string& file) const {
    return read_text_file((path_ / file).string());
  }

  StudyCsv csv(const std::string& file) const {
    const std::string all = text(file);
    StudyCsv csv;
    for (const std::string_view line : lines_of(all)) {
      std::vector<std::string> cells;
      for (const std::string_view cell : cells_of(line)) cells.emplace_back(cell);
      if (csv.columns.empty()) {
        csv.columns = cells;
        continue;
      }
      EXPECT_GE(cells.size(), csv.columns.size()) << file << ": " << line;
      csv.rows.push_back(cells);
    }
    return csv;
  }

  /// Whether the chart exists and contains no invalid number.
  bool has_chart(const std::string& file) const {
    const std::string svg = text(file);
    return svg.find("<svg") != std::string::npos && svg.find("nan") == std::string::npos;
  }

 private:
  std::filesystem::path path_;
};

}  // namespace heft
