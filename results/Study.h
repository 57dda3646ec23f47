// The studies of `heft bench`. Each writes CSV and SVG files to a folder of results/. Study.cpp has
// their table.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <ctime>
#include <fstream>
#include <span>
#include <string>
#include <string_view>

namespace heft {

struct StudyOptions {
  std::string out;         ///< the folder for its files
  std::string command;     ///< command line, for captions
  bool quick = false;      ///< a small part, as a smoke test
  std::uint64_t seed = 1;  ///< of random draws
};

struct StudyEntry {
  std::string_view name;
  std::string_view summary;
  void (*run)(const StudyOptions& options);
};

std::span<const StudyEntry> studies();

/// @throws Error (usage) with the nearest name if there is no such study
const StudyEntry& study_named(std::string_view name);

// Outputs of every study: CSV files and charts with their commit and command, and progress on
// stderr.

/// "commit 1a2b3c4 · heft bench physics": the end of every caption.
std::string provenance(const StudyOptions& options);
/// Of a table that was written before, by the last cells of its rows.
std::string provenance(std::string_view commit, std::string_view command);

/// A CSV file whose last columns are the commit and the command.
class CsvFile {
 public:
  /// @param name with extension  @param columns separated by commas
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

  std::string end_;  ///< taken before the file is opened, which modifies the checkout
  std::ofstream out_;
};

/// "3 of 20: boxes" on stderr if that is a terminal; cleared at the end.
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

/// Draws NAME.svg with gnuplot; prints a note on stderr if gnuplot is not installed.
void draw(const StudyOptions& options, const std::string& name, const std::string& script);

// A clock that other processes do not disturb.

/// Seconds that this thread has spent on a processor.
inline double thread_cpu_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace heft
