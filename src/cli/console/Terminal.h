// The terminal: data on stdout, messages and progress on stderr, Ctrl-C as a flag. A command
// succeeds only if its data were written completely. Messages never fail, because a closed stderr
// or a full disk behind it must not end a session.
#pragma once

#include <fmt/format.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "base/Error.h"
#include "base/files/Printable.h"

namespace heft {
struct ReportResult;
}

namespace heft::cli {

/// Writes to stderr unchanged, including control sequences.
inline void draw(const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
}

/// Rings the terminal's bell, if stderr is one: the experimenter is needed.
void ring();

/// Writes a message to stderr, with control characters escaped.
template <typename... Args>
void say(fmt::format_string<Args...> format, Args&&... args) {
  draw(escaped(fmt::format(format, std::forward<Args>(args)...)));
}

/// Writes text to stdout, with control characters escaped, since names and notes may come from any
/// file.
template <typename... Args>
void print(fmt::format_string<Args...> format, Args&&... args) {
  fmt::print("{}", escaped(fmt::format(format, std::forward<Args>(args)...)));
}

/// Replaces a file, and says under which name the previous one is kept.
/// @throws Error as replace_text_file
void replace_file(const std::string& path, const std::string& text);

/// Flushes stdout, so that later messages on stderr follow it.
/// @throws Error if it cannot be written
void flush_output();

/// Width of the terminal that a file descriptor is; none: it is no terminal.
std::optional<int> terminal_width(int file_descriptor);

/// Columns of the terminal that a line needs: many characters beyond the alphabets need two.
int columns_of(std::string_view line);

/// The error for a failed write to stdout.
Error output_error(const std::string& reason);

/// "31 of about 70"; "71" if the expected number is exceeded.
std::string of_about(int n_done, double expected, std::string_view between = " of about ");

/// A progress bar on stderr, if that is a terminal.
class ProgressBar {
 public:
  /// @param label of the work in progress
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

/// While such an object exists, SIGINT, SIGTERM and SIGHUP set the flag instead of ending the
/// program. An ignored SIGHUP (nohup) stays ignored.
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

/// While such an object exists, SIGTSTP (Ctrl-Z) sets the flag instead of stopping the program, so
/// that a session can pause first. A second one stops it immediately. One object at a time.
class SuspendOnSignal {
 public:
  SuspendOnSignal();
  ~SuspendOnSignal();
  SuspendOnSignal(const SuspendOnSignal&) = delete;
  SuspendOnSignal& operator=(const SuspendOnSignal&) = delete;

  std::atomic<bool>& requested() const;

  /// Restores the terminal and stops the program until it is continued (fg).
  static void stop_now();
};

inline constexpr std::string_view missing_charts =
    "No charts: gnuplot is not installed (sudo apt-get install gnuplot-nox).";

/// Prints how to draw a report's charts, if they were not drawn.
void explain_missing_charts(const ReportResult& report, const std::string& folder);

/// The keyboard key by key: while this object exists, the terminal has no line editing and no echo.
/// Restored whenever SuspendOnSignal stops the program, or it ends.
class RawTerminal {
 public:
  /// Has no effect unless stdin and stderr are both terminals. One object at a time.
  RawTerminal();
  ~RawTerminal();
  RawTerminal(const RawTerminal&) = delete;
  RawTerminal& operator=(const RawTerminal&) = delete;

  bool is_there() const { return is_there_; }

  /// Whether keys can be read: not while the program runs in the background. Restores the
  /// key-by-key mode if another program changed it.
  bool listens();

  /// Current number of columns of the terminal; 80 if unknown.
  static int width();

 private:
  bool is_there_;
};

}  // namespace heft::cli
