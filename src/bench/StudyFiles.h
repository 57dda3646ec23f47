// What every study leaves behind: CSV files and charts that say which commit and command made them,
// and a line on stderr while it runs.
#pragma once

#include <fmt/format.h>

#include <fstream>
#include <string>
#include <string_view>

#include "bench/Study.h"

namespace heft {

/// "commit 1a2b3c4 · heft bench physics": the end of every caption.
std::string provenance(const StudyOptions& options);

/// A CSV file whose last columns are the commit and the command.
class CsvFile {
 public:
  /// @param name with its ending  @param columns separated by commas
  /// @throws Error when it can't be written
  CsvFile(const StudyOptions& options, const std::string& name, std::string_view columns);

  /// As many cells as there are columns; NaN is an empty cell.
  template <typename... Cells>
  void row(const Cells&... cells) {
    ((out_ << cell(cells) << ','), ...);
    out_ << end_ << '\n';
  }

 private:
  static std::string cell(std::string_view text);
  static std::string cell(double value);

  std::string end_;  ///< before the file opens: an open file makes the tree a changed one
  std::ofstream out_;
};

/// "3 of 20: boxes" on stderr where that is a terminal; gone when the work is done.
class StudyProgress {
 public:
  explicit StudyProgress(int n) : n_(n) {}
  ~StudyProgress();
  StudyProgress(const StudyProgress&) = delete;
  StudyProgress& operator=(const StudyProgress&) = delete;

  /// Starts the next of the n parts.
  void next(std::string_view what);

 private:
  int n_, done_ = 0;
};

/// Draws NAME.svg by gnuplot; says so on stderr where gnuplot is not installed.
void draw(const StudyOptions& options, const std::string& name, const std::string& script);

}  // namespace heft
