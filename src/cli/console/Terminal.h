// The terminal: data on stdout, messages and progress on stderr, Ctrl-C as a flag. A command has
// done its work only once its data are where they should be; but a stderr that has gone, a reader
// that went away or a full disk behind it must not end a session, so nothing that is said there
// fails.
#pragma once

#include <fmt/format.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <string>
#include <string_view>
#include <utility>

#include "base/Error.h"
#include "base/files/Printable.h"

namespace heft {
struct ReportResult;
}

namespace heft::cli {

/// On stderr, as it stands, with what moves a terminal's cursor.
inline void draw(const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
}

/// The terminal's bell, where stderr is one: somebody has to look.
void ring();

/// On stderr; whatever names, notes and cells are in it, a terminal only shows them.
template <typename... Args>
void say(fmt::format_string<Args...> format, Args&&... args) {
  draw(escaped(fmt::format(format, std::forward<Args>(args)...)));
}

/// Prints text for people, in which names and notes of any file may stand: a terminal only shows
/// them.
template <typename... Args>
void print(fmt::format_string<Args...> format, Args&&... args) {
  fmt::print("{}", escaped(fmt::format(format, std::forward<Args>(args)...)));
}

/// Writes out what was printed so far, so that what is said on stderr comes after it.
/// @throws Error when it can't be written
void flush_output();

/// Columns of the terminal that a line takes: most of what lies beyond the alphabets takes two.
int columns_of(std::string_view line);

/// What is said when stdout can't be written.
Error output_error(const std::string& reason);

/// "31 of about 70"; "71" where more were done than was expected.
std::string of_about(int n_done, double expected, std::string_view between = " of about ");

/// On stderr, when stderr is a terminal.
class ProgressBar {
 public:
  /// @param label what is going on
  explicit ProgressBar(std::string label);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// @param done 0...1  @param text beside the bar
  void update(double done, const std::string& text);

 private:
  std::string label_;
  bool shown_;
  std::chrono::steady_clock::time_point drawn_{};
};

/// While one of these lives, SIGINT, SIGTERM and SIGHUP set the flag instead of ending the program.
/// A SIGHUP that was ignored (nohup) stays ignored.
class StopOnSignal {
 public:
  StopOnSignal();
  ~StopOnSignal();
  StopOnSignal(const StopOnSignal&) = delete;
  StopOnSignal& operator=(const StopOnSignal&) = delete;

  const std::atomic<bool>& requested() const;

 private:
  std::array<void (*)(int), 3> before_{};
};

inline constexpr std::string_view missing_charts =
    "No charts: gnuplot is not installed (sudo apt-get install gnuplot-nox).";

/// Says how to get the charts of a report in `folder`, if they were not drawn.
void explain_missing_charts(const ReportResult& report, const std::string& folder);

}  // namespace heft::cli
