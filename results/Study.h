// The studies behind `heft bench`: each writes CSV and SVG into a folder of results/. One table, in
// Study.cpp, names them all.
#pragma once

#include <fmt/format.h>
#include <time.h>

#include <cstdint>
#include <fstream>
#include <span>
#include <string>
#include <string_view>

namespace heft {

struct StudyOptions {
  std::string out;         ///< the folder for its files
  std::string command;     ///< how it was called, for captions
  bool quick = false;      ///< a small part, to see that everything works
  std::uint64_t seed = 1;  ///< of what a study draws at random
};

struct StudyEntry {
  std::string_view name;
  std::string_view summary;
  void (*run)(const StudyOptions& options);
};

std::span<const StudyEntry> studies();

/// @throws Error (usage) naming the nearest study when there is none of that name
const StudyEntry& study_named(std::string_view name);

// What every study leaves behind: CSV files and charts that say which commit and command made them,
// and a line on stderr while it runs.

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

// What the studies time with: a clock that other processes don't disturb.

/// Seconds that this thread has spent on a processor.
inline double thread_cpu_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace heft
